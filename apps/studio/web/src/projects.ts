// Going from project to project, and from model to model.
import { unzip, zip, type Unzipped } from 'fflate'
import { api, bytes, downloadBlob, Refused, Stopped, type NamedFile } from './api'
import { app, documentOf, type Busy } from './app'
import { withModel } from './edits'
import { pictureNow } from './pictures'
import { sides, type Examined, type Side } from './types'

// What is shown while a file goes to the program and is read there.
const sending = (busy: Busy, name: string) => (part: number) => {
  Object.assign(busy, part < 1 ? { text: `Sending ${name}`, part } : { text: `Reading ${name}`, part: undefined })
  app.changed()
}

const stemOf = (name: string) => name.replace(/\.[^.]+$/, '')

async function enter(how: () => Promise<unknown>) {
  await app.saver.flush(true)
  await pictureNow()
  await how()
  await app.refresh(true)
}

export const openRecent = (id: string) => app.attempt(() => enter(() => api.openProject(id)), 'Opening the project')
export const startNew = () => app.attempt(() => enter(api.newProject))

export const openSample = (name: string) =>
  app.attempt(async () => {
    await enter(() => api.sample(name, true))
    app.set({ step: 'markers' })
  }, 'Making the sample')

async function addProject(files: NamedFile[], name: string, busy: Busy, signal: AbortSignal) {
  await app.saver.flush()
  const { id } = await api.addProject(files, sending(busy, name), signal)
  if (!signal.aborted) await enter(() => api.openProject(id))
}

// Two models are a project of their own: what is open stays as it is.
export const openPair = (source: File, target: File) =>
  app.attempt(async (busy, signal) => {
    const place = (side: Side, file: File) => `models/${side}/${file.name}`
    const project = {
      meshtween_project: 1,
      source: { path: place('source', source), hash: '' },
      target: { path: place('target', target), hash: '' },
      markers: [],
    }
    const files = [
      { name: 'project.json', blob: new Blob([JSON.stringify(project)]) },
      { name: project.source.path, blob: source },
      { name: project.target.path, blob: target },
    ]
    await addProject(files, `${source.name} and ${target.name}`, busy, signal)
    app.toast(`${source.name} is the source, ${target.name} the target.`)
  }, 'Reading two models', true)

export const openProject = (file: File) =>
  app.attempt(async (busy, signal) => {
    const isZip = file.name.toLowerCase().endsWith('.zip')
    const files = isZip ? await unpacked(file) : [{ name: 'project.json', blob: file }]
    await addProject(files, file.name, busy, signal)
  }, 'Opening the project', true)

async function unpacked(file: File): Promise<NamedFile[]> {
  const packed = new Uint8Array(await file.arrayBuffer())
  const found = await new Promise<Unzipped | null>((resolve) => unzip(packed, (error, files) => resolve(error ? null : files)))
  if (!found) throw new Refused(`${file.name} cannot be unpacked; it is damaged, or no zip.`)
  const names = Object.keys(found).filter((name) => !name.endsWith('/') && !name.includes('__MACOSX'))
  const project = names.find((name) => /(^|\/)project\.json$/.test(name))
  if (project === undefined) throw new Refused(`${file.name} holds no project.json: it is no copy of a project.`)
  const folder = project.slice(0, -'project.json'.length) // as where a folder was packed
  return names
    .filter((name) => name.startsWith(folder))
    .map((name) => ({ name: name.slice(folder.length), blob: new Blob([found[name] as Uint8Array<ArrayBuffer>]) }))
    .filter(({ name }) => name === 'project.json' || name === 'project.png' || name === 'project.fitted.ply' || name.startsWith('models/'))
}

// The project with its models as one file: it opens on any machine.
export const saveCopy = () =>
  app.attempt(async (busy, signal) => {
    await app.saver.flush()
    const project = await api.project()
    const files: Record<string, Uint8Array> = {}
    for (const side of sides) {
      const info = app.info(side)
      if (!info) continue
      Object.assign(busy, { text: `Packing ${info.name}` })
      app.changed()
      const path = `models/${side}/${info.name}`
      files[path] = new Uint8Array(await bytes('api/model', { side }))
      project[side] = { path, hash: info.hash }
    }
    if (app.state?.fit) files['project.fitted.ply'] = new Uint8Array(await bytes('api/fitted-file'))
    files['project.json'] = new TextEncoder().encode(JSON.stringify({ ...project, named: [] }, null, 2) + '\n')
    const packed = await new Promise<Uint8Array>((resolve, reject) => {
      const stop = zip(files, { level: 6 }, (error, data) => (error ? reject(error) : resolve(data)))
      signal.addEventListener('abort', () => (stop(), reject(new Stopped())))
    })
    downloadBlob(new Blob([packed as Uint8Array<ArrayBuffer>], { type: 'application/zip' }), `${projectName()}.zip`)
  }, 'Packing the project', true)

// What a project is called: after its models, or after what their names have in common.
export function titleOf(source: string, target: string): string {
  const [from, to] = [stemOf(source), stemOf(target)]
  const [one, other] = [/^(.+)[ _-]source$/i.exec(from)?.[1], /^(.+)[ _-]target$/i.exec(to)?.[1]]
  if (one && one === other) return one
  return `${from || '…'} to ${to || '…'}`
}

const projectName = () => (app.info('source') && app.info('target') ? titleOf(app.info('source')!.name, app.info('target')!.name) : 'project')

export const openModel = async (side: Side, file: File) => {
  const found = await app.attempt((busy, signal) => api.upload(side, file, sending(busy, file.name), signal), `Sending ${file.name}`, true)
  if (found) await takeModel(side, found)
}

export const readAgain = async (side: Side) => {
  const found = await app.attempt(() => api.examine(side), `Reading ${app.info(side)?.name}`)
  if (found) await takeModel(side, found)
}

const few = (count: number, one: string, many: string) => (count === 1 ? one : `${count} ${many}`)

// Replacing a model is asked for, with what becomes of the markers, and is one edit.
async function takeModel(side: Side, found: Examined) {
  const now = app.info(side)
  const { markers } = app.store.document
  const lost = found.carried.filter(({ at }) => at === null).map(({ id }) => markers.find((marker) => marker.id === id)?.name ?? '')
  if (now || lost.length > 0) {
    const kept = found.carried.length - lost.length
    const lines: string[] = []
    if (kept > 0) lines.push(`${few(kept, 'One of its markers lies', 'of its markers lie')} on the new model and ${kept === 1 ? 'is' : 'are'} kept there.`)
    if (lost.length > 0)
      lines.push(`${few(lost.length, 'One lies', 'lie')} too far from it and ${lost.length === 1 ? 'becomes' : 'become'} missing on the ${side}: ${lost.slice(0, 8).join(', ')}${lost.length > 8 ? ' …' : '.'}`)
    if (app.state?.fit) lines.push('The fit is of the old model and is put aside.')
    lines.push('Undo brings everything back.')
    const title = now ? (found.name === now.name ? `Read ${found.name} again?` : `Replace ${now.name} by ${found.name}?`) : `Open ${found.name} as the ${side}?`
    if ((await app.ask({ title, lines, choices: [{ label: now ? 'Replace' : 'Open', answer: 'yes', primary: true }] })) === null) return
  }
  await app.attempt(async () => {
    app.store.edit(`${now ? 'replace' : 'open'} the ${side}`, (d) => withModel(d, side, found))
    await app.saver.flush()
    await app.refresh(false)
    app.toast(`${found.name} is the ${side}.`)
  }, `Opening ${found.name}`)
}

// A model that was dropped beside the views.
export async function askSide(file: File) {
  const aside = (side: Side) => (app.info(side) ? `replaces ${app.info(side)!.name}` : 'empty so far')
  const empty = sides.find((side) => !app.info(side))
  const answer = await app.ask({
    title: `What is ${file.name}?`,
    lines: ['The source is the model whose mesh is kept; the target is what it turns into.'],
    choices: sides.map((side) => ({ label: side === 'source' ? 'The source' : 'The target', answer: side, aside: aside(side), primary: side === empty })),
  })
  if (answer) await openModel(answer as Side, file)
}

// Back to a state of before, as an edit like any other.
export const goBackTo = (name: string, label: string) =>
  app.attempt(async () => {
    const document = documentOf(await api.kept(name))
    app.store.edit(`go back to ${label}`, () => document)
    await app.saver.flush()
    await app.refresh(false)
    app.toast(`This is the project of ${label}. Undo goes forward again.`)
  }, 'Going back')
