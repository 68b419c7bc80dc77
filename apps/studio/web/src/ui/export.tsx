// Writing files, through the same code as the command line.
import { useState } from 'preact/hooks'
import { api } from '../api'
import { app } from '../app'
import { exports, fetchExport, startExport } from '../work'
import { Button, JobBar, Section } from './parts'

const kinds: [string, string, string][] = [
  ['morph.glb', 'GLB', 'A playable glTF for Blender, games and viewers'],
  ['morph.html', 'HTML', 'One page that plays the morph; needs no network'],
  ['morph.png', 'PNG', 'A contact sheet: source, target and shapes between'],
  ['morph.apng', 'Animated PNG', 'A picture that moves, for pages and slides'],
  ['fitted.ply', 'Fitted mesh (PLY)', "The source's mesh on the target"],
  ['fitted.obj', 'Fitted mesh (OBJ)', "The source's mesh on the target, with its UVs"],
  ['frame_####.obj', 'OBJ sequence', 'A numbered mesh a frame'],
  ['frame_####.ply', 'PLY sequence', 'A numbered mesh a frame'],
  ['frame_####.png', 'PNG sequence', 'A numbered picture a frame, for a film'],
]

export function ExportPanel() {
  const [chosen, choose] = useState<string[]>(['morph.glb'])
  const [frames, setFrames] = useState(25)
  const running = app.running && app.job.kind === 'export'
  return (
    <>
      <Section title="Export">
        {kinds.map(([name, label, help]) => (
          <label class="check tall" key={name}>
            <input
              type="checkbox"
              checked={chosen.includes(name)}
              onChange={(e) => choose(e.currentTarget.checked ? [...chosen, name] : chosen.filter((one) => one !== name))}
            />
            <span>
              <b>{label}</b>
              <small>{help}</small>
            </span>
          </label>
        ))}
        {chosen.some((name) => name.includes('#') || name.endsWith('.apng')) && (
          <label class="inline">
            Frames, both ends included
            <input type="number" min={2} max={10000} value={frames} onChange={(e) => setFrames(e.currentTarget.valueAsNumber || 25)} />
          </label>
        )}
        {running ? (
          <>
            <JobBar kind="export" />
            <Button onClick={() => void app.attempt(() => api.cancel())} keys="Escape">
              Cancel
            </Button>
          </>
        ) : (
          <Button primary disabled={!app.state?.fit || chosen.length === 0 || app.running || app.readOnly} onClick={() => void startExport(chosen, frames)}>
            Export
          </Button>
        )}
        {!app.state?.fit && <small class="warn">There is no fit yet.</small>}
      </Section>
      {exports.files.length > 0 && (
        <Section title="Written">
          <small>
            in <code>{exports.folder}</code>
          </small>
          <ul class="files">
            {exports.files.slice(0, 30).map((name) => (
              <li key={name}>
                <button type="button" class="small" onClick={() => fetchExport(name)}>
                  {name}
                </button>
              </li>
            ))}
            {exports.files.length > 30 && <li>and {exports.files.length - 30} more</li>}
          </ul>
        </Section>
      )}
    </>
  )
}
