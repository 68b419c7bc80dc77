// The open project, those of before, and the states that the open one has been in.
import { useEffect, useState } from 'preact/hooks'
import { api } from '../api'
import { app } from '../app'
import { goBackTo, openProject, openRecent, saveCopy, startNew, titleOf } from '../projects'
import type { KeptState, ProjectInfo } from '../types'
import { Button, chooseFiles, Section } from './parts'

const minute = 60000

// A moment as people say it.
export function when(moment: number): string {
  const then = new Date(moment)
  const ago = Date.now() - moment
  if (ago < minute) return 'just now'
  if (ago < 60 * minute) return `${Math.floor(ago / minute)} min ago`
  const clock = then.toLocaleTimeString('en-GB', { hour: '2-digit', minute: '2-digit' })
  const days = Math.round((new Date().setHours(0, 0, 0, 0) - new Date(moment).setHours(0, 0, 0, 0)) / (24 * 60 * minute))
  if (days === 0) return `today ${clock}`
  if (days === 1) return `yesterday ${clock}`
  return `${then.toLocaleDateString('en-GB', { day: 'numeric', month: 'short', year: 'numeric' })}`
}

const markersOf = (count: number) => (count === 0 ? 'no markers' : count === 1 ? '1 marker' : `${count} markers`)

// What the program tells, asked for again whenever `key` differs.
function useTold<T>(ask: () => Promise<T[]>, key: unknown): T[] {
  const [list, setList] = useState<T[]>([])
  useEffect(() => {
    let mine = true
    void ask().then((told) => mine && setList(told), () => {})
    return () => void (mine = false)
  }, [key])
  return list
}

function Project({ project }: { project: ProjectInfo }) {
  return (
    <button type="button" class="project" title={`${project.source || 'no source'}, ${project.target || 'no target'}`} disabled={app.readOnly || app.running} onClick={() => void openRecent(project.id)}>
      {project.picture ? <img src={`api/projects/picture?id=${encodeURIComponent(project.id)}&at=${project.saved}`} alt="" loading="lazy" /> : <i class="nothing" />}
      <b>{titleOf(project.source, project.target)}</b>
      <small>
        {markersOf(project.markers)}
        {project.fitted && ', fitted'}
      </small>
      <small>{when(project.saved)}</small>
    </button>
  )
}

export function Recent() {
  const [all, showAll] = useState(false)
  const list = useTold(api.projects, app.state?.project.number).filter((project) => !project.open)
  if (list.length === 0) return null
  const some = all ? list : list.slice(0, 4)
  return (
    <Section title="Recent projects">
      <div class="projects">
        {some.map((project) => (
          <Project project={project} key={project.id} />
        ))}
      </div>
      {list.length > some.length && (
        <button type="button" class="small" onClick={() => showAll(true)}>
          All {list.length}
        </button>
      )}
    </Section>
  )
}

export function ProjectSection() {
  const started = app.info('source') || app.info('target') || app.store.document.markers.length > 0
  return (
    <Section title="Project">
      <small>
        Saved as you work, in <code>{app.state?.project.file}</code>
      </small>
      <div class="row">
        <Button disabled={!started} onClick={() => void saveCopy()} title="One file with the project and its models, to keep or to take elsewhere">
          Save a copy
        </Button>
        <Button disabled={app.readOnly || app.running} title="A copy of a project, or its project.json" onClick={() => chooseFiles('.zip,.json', false, ([file]) => void openProject(file))}>
          Open…
        </Button>
        <Button disabled={app.readOnly || app.running || !started} title="Begin another project; this one stays" onClick={() => void startNew()}>
          New
        </Button>
      </div>
    </Section>
  )
}

export function Earlier() {
  const list = useTold<KeptState>(api.states, `${app.state?.project.number} ${app.saver.state}`)
  if (list.length === 0) return null
  return (
    <details>
      <summary>
        Earlier states <small>the last {list.length}</small>
      </summary>
      <ul class="states">
        {list.map(({ name, saved, markers }) => (
          <li key={name}>
            <button type="button" class="small" disabled={app.readOnly || app.running} title="Go back to it; undo goes forward again" onClick={() => void goBackTo(name, when(saved))}>
              <span>{when(saved)}</span> <small>{markersOf(markers)}</small>
            </button>
          </li>
        ))}
      </ul>
    </details>
  )
}
