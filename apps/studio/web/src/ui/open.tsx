// The models, the samples and the projects: opened by dialogue, or dropped on the page.
import { app } from '../app'
import { sortOut } from '../files'
import { askSide, openModel, openPair, openProject, openSample } from '../projects'
import { sides, type Side } from '../types'
import { importMarkers } from './import'
import { Button, chooseFiles, count, Section } from './parts'
import { Earlier, ProjectSection, Recent } from './recent'
import { Linked } from './told'

// Two models begin a project; one goes where it was dropped, or where a person says.
export async function take(files: File[], side?: Side) {
  if (app.readOnly) return app.toast('Another tab is editing; take over first.', true)
  if (app.running) return app.toast('A job is running; cancel it first.', true)
  const { meshes, markers, projects } = await sortOut(files)
  if (projects.length > 0) await openProject(projects[0])
  if (meshes.length > 2) app.toast(`${meshes.length} models at once: the first two are taken as source and target.`, true)
  if (meshes.length >= 2) await openPair(meshes[0], meshes[1])
  else if (meshes.length === 1) await (side ? openModel(side, meshes[0]) : askSide(meshes[0]))
  if (markers.length > 0) await importMarkers(markers, side)
}

function MeshCard({ side }: { side: Side }) {
  const info = app.info(side)
  const formats = (app.state?.mesh_formats ?? []).join(',')
  return (
    <div class="card" data-side={side}>
      <header>
        <i class={`dot ${side}`} /> {side === 'source' ? 'Source' : 'Target'}
        <Button small disabled={app.readOnly || app.running} onClick={() => chooseFiles(formats, false, (files) => void take(files, side))}>
          {info ? 'Replace…' : 'Open…'}
        </Button>
      </header>
      {info ? (
        <>
          <b class="file" title={info.path}>
            {info.name}
          </b>
          <small>
            {count(info.vertices)} vertices, {count(info.triangles)} triangles
          </small>
          {info.notes.map((note) => (
            <small key={note}>
              <Linked text={note} />
            </small>
          ))}
          {info.findings.map((finding) => (
            <small class={finding.warning ? 'warn' : ''} key={finding.what}>
              <Linked text={finding.what} side={side} />
            </small>
          ))}
        </>
      ) : (
        <small>{side === 'source' ? 'The model to start from. Its mesh is kept.' : 'The model to end at.'}</small>
      )}
    </div>
  )
}

export function OpenPanel() {
  const started = app.info('source') || app.info('target')
  return (
    <>
      <Section title="Models">
        {sides.map((side) => (
          <MeshCard side={side} key={side} />
        ))}
        <small>Or drop files anywhere on the page: {(app.state?.mesh_formats ?? []).join(' ')}</small>
      </Section>
      {app.info('source') && app.info('target') && (
        <Button primary onClick={() => app.set({ step: 'markers' })}>
          Place markers
        </Button>
      )}
      {started && <ProjectSection />}
      <Recent />
      <Section title="Try a sample">
        <div class="samples">
          {app.state?.samples.map((sample) => (
            <button type="button" key={sample.name} disabled={app.readOnly || app.running} onClick={() => void openSample(sample.name)}>
              <b>{sample.name}</b> <small>{sample.description}</small>
            </button>
          ))}
        </div>
      </Section>
      {!started && <ProjectSection />}
      <Earlier />
    </>
  )
}
