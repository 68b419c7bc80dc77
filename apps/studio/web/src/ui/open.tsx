// Opening models, samples and projects: by dialogue, or dropped on the page.
import { api, download } from '../api'
import { app } from '../app'
import { merge } from '../edits'
import { sides, type Side } from '../types'
import { Button, chooseFiles, count, Section } from './parts'

export const openMesh = (side: Side, file: File) =>
  app.attempt(async () => {
    await api.upload(side, file)
    await app.refresh(false)
    app.toast(`${file.name} is the ${side}.`)
  }, `Reading ${file.name}`)

const openProject = (file: File) =>
  app.attempt(async () => {
    await api.openProject(await file.text())
    await app.refresh(true)
  }, 'Opening the project')

export const importMarkers = (files: File[]) =>
  app.attempt(async () => {
    const { pairs, notes } = await api.importMarkers(files.slice(0, 2))
    const { after, added, moved, locked } = merge(app.store.document, pairs)
    if (added + moved > 0) app.store.edit(`import ${pairs.length} markers`, () => after)
    for (const note of notes) app.toast(note, true)
    const told = [`${added} markers added`, moved && `${moved} of the same name moved`, locked && `${locked} locked ones left`]
    app.toast(`${told.filter(Boolean).join(', ')}, from ${files.map((file) => file.name).join(' and ')}.`)
    app.set({ step: 'markers' })
  }, 'Reading markers')

const isMesh = (file: File) => (app.state?.mesh_formats ?? []).some((ending) => file.name.toLowerCase().endsWith(ending))

// One mesh goes where it was dropped, or to the side that is still empty; two become source and target.
export async function dropped(files: File[], side?: Side) {
  const meshes = files.filter(isMesh)
  const rest = files.filter((file) => !isMesh(file))
  if (meshes.length >= 2) {
    await openMesh('source', meshes[0])
    await openMesh('target', meshes[1])
  } else if (meshes.length === 1) {
    await openMesh(side ?? (app.info('source') && !app.info('target') ? 'target' : 'source'), meshes[0])
  }
  if (rest.length === 0) return
  const text = rest.length === 1 && rest[0].name.endsWith('.json') ? await rest[0].text() : ''
  if (text.includes('"meshtween_project"')) await openProject(rest[0])
  else await importMarkers(rest)
}

function MeshCard({ side }: { side: Side }) {
  const info = app.info(side)
  const formats = (app.state?.mesh_formats ?? []).join(',')
  return (
    <div class="card">
      <header>
        <i class={`dot ${side}`} /> {side === 'source' ? 'Source' : 'Target'}
        <Button small disabled={app.readOnly || app.running} onClick={() => chooseFiles(formats, false, ([file]) => void openMesh(side, file))}>
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
          {info.findings.map((finding) => (
            <small class={finding.warning ? 'warn' : ''} key={finding.what}>
              {finding.what}
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
  return (
    <>
      <Section title="Models">
        {sides.map((side) => (
          <MeshCard side={side} key={side} />
        ))}
        <small>Or drop files anywhere on the page: {(app.state?.mesh_formats ?? []).join(' ')}</small>
      </Section>
      <Section title="Try a sample">
        <div class="samples">
          {app.state?.samples.map((sample) => (
            <button
              type="button"
              key={sample.name}
              disabled={app.readOnly || app.running}
              onClick={() =>
                void app.attempt(async () => {
                  await api.sample(sample.name, true)
                  await app.refresh(true)
                  app.set({ step: 'markers' })
                }, 'Making the sample')
              }
            >
              <b>{sample.name}</b> <small>{sample.description}</small>
            </button>
          ))}
        </div>
      </Section>
      <Section title="Project">
        <small>
          Saved as you work, in <code>{app.state?.project.file}</code>
        </small>
        <div class="row">
          <Button onClick={() => download('api/project', 'project.json')} title="A copy of the project as JSON">
            Save a copy
          </Button>
          <Button disabled={app.readOnly} onClick={() => chooseFiles('.json', false, ([file]) => void openProject(file))}>
            Open…
          </Button>
          <Button
            disabled={app.readOnly || app.running}
            onClick={() => {
              if (confirm('Start anew? Models and markers of this project are closed.'))
                void app.attempt(async () => {
                  await api.newProject()
                  await app.refresh(true)
                })
            }}
          >
            New
          </Button>
        </div>
      </Section>
      {app.info('source') && app.info('target') && (
        <Button primary onClick={() => app.set({ step: 'markers' })}>
          Place markers
        </Button>
      )}
    </>
  )
}
