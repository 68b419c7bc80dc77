// The program behind the page. All addresses are relative: the token is part of the page's own.
import type { Document, Examined, ImportedMarker, KeptState, ProjectInfo, Side, State, Vec3 } from './types'

export const tab = crypto.randomUUID()

// What a person can be told as it is.
export class Refused extends Error {}
// A person stopped it.
export class Stopped extends Error {}

async function ask(path: string, init?: RequestInit): Promise<Response> {
  let response: Response
  try {
    response = await fetch(path, init)
  } catch {
    throw new Refused('The studio program does not answer. Start it again: nothing that you made is lost.')
  }
  if (response.ok) return response
  const told = (await response.json().catch(() => ({}))) as { error?: string }
  throw new Refused(told.error ?? `The program answered ${response.status}.`)
}

const query = (values: Record<string, string | number>) =>
  new URLSearchParams(Object.entries(values).map(([name, value]) => [name, String(value)])).toString()

async function get<T>(path: string): Promise<T> {
  return (await ask(path)).json() as Promise<T>
}

async function post<T = unknown>(path: string, body: BodyInit = ''): Promise<T> {
  const keepalive = typeof body === 'string' && body.length < 60000 // such a request outlives its page
  return (await ask(path, { method: 'POST', body, keepalive, headers: { 'X-Tab': tab } })).json() as Promise<T>
}

// Sends much, and tells how much of it has gone.
function send<T>(path: string, body: Blob, progress: (part: number) => void, signal: AbortSignal): Promise<T> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest()
    const stop = () => request.abort()
    signal.addEventListener('abort', stop)
    request.open('POST', path)
    request.setRequestHeader('X-Tab', tab)
    request.upload.onprogress = (event) => event.lengthComputable && progress(event.loaded / event.total)
    request.onload = () => {
      const told = JSON.parse(request.responseText || '{}')
      if (request.status === 200) resolve(told)
      else reject(new Refused(told.error ?? `The program answered ${request.status}.`))
    }
    request.onerror = () => reject(new Refused('The file could not be sent: the studio program does not answer, or the file can no longer be read.'))
    request.onabort = () => reject(new Stopped())
    request.onloadend = () => signal.removeEventListener('abort', stop)
    if (signal.aborted) return reject(new Stopped())
    request.send(body)
  })
}

export interface NamedFile {
  name: string
  blob: Blob
}

export async function bytes(path: string, values: Record<string, string | number> = {}): Promise<ArrayBuffer> {
  return (await ask(`${path}?${query(values)}`)).arrayBuffer()
}

export const api = {
  state: () => get<State>('api/state'),
  changes: () => get<Record<Side, boolean>>('api/changes'),
  save: (document: Document, project: number) => post(`api/document?${query({ project })}`, JSON.stringify(document)),
  saveHistory: (text: string) => post('api/history', text),
  history: async () => (await ask('api/history')).text(),
  savePicture: (png: Blob) => post('api/picture', png),
  states: () => get<KeptState[]>('api/states'),
  kept: (name: string) => get<State['document']>(`api/kept?${query({ name })}`),
  upload: (side: Side, file: File, progress: (part: number) => void, signal: AbortSignal) =>
    send<Examined>(`api/upload?${query({ side, name: file.name })}`, file, progress, signal),
  examine: (side: Side) => post<Examined>(`api/examine?${query({ side })}`),
  sample: (name: string, markers: boolean) => post(`api/sample?${query({ name, markers: markers ? 'yes' : 'no' })}`),
  project: () => get<Record<string, unknown>>('api/project'),
  projects: () => get<ProjectInfo[]>('api/projects'),
  openProject: (id: string) => post(`api/projects/open?${query({ id })}`),
  addProject: (files: NamedFile[], progress: (part: number) => void, signal: AbortSignal) =>
    send<{ id: string }>('api/projects/add', bundle(files), progress, signal),
  newProject: () => post('api/new'),
  fit: (options: unknown) => post('api/fit', JSON.stringify(options)),
  morph: (request: unknown) => post('api/morph', JSON.stringify(request)),
  export: (request: unknown) => post('api/export', JSON.stringify(request)),
  cancel: () => post('api/cancel'),
  takeOver: () => post(`api/take-over?${query({ tab })}`),
  guess: (from: Side, points: Vec3[]) => post<Vec3[]>(`api/guess?${query({ from })}`, JSON.stringify(points)),
  warnings: () => get<string[]>('api/warnings'),
  suggestions: () => get<{ at: Vec3; why: string; target?: Vec3 }[]>('api/suggestions'),
  importMarkers: (files: File[], side?: Side) =>
    post<{ markers: ImportedMarker[]; notes: string[]; ask_side: boolean }>(
      `api/markers/import?${query(side ? { side } : {})}`,
      bundle(files.map((file) => ({ name: file.name, blob: file }))),
    ),
  exportMarkers: (format: string) =>
    get<{ files: { name: string; text: string }[]; notes: string[] }>(`api/markers/export?${query({ format })}`),
}

// Several files as one body: a line that lists them, then their bytes.
function bundle(files: NamedFile[]): Blob {
  const list = files.map(({ name, blob }) => ({ name, size: blob.size }))
  return new Blob([JSON.stringify(list), '\n', ...files.map(({ blob }) => blob)])
}

// Calls back for each message; tells the program when the page goes.
export function listen(handlers: Record<string, (data: any) => void>, lost: (gone: boolean) => void) {
  const stream = new EventSource(`api/events?${query({ tab })}`)
  for (const [name, handler] of Object.entries(handlers))
    stream.addEventListener(name, (event) => handler(JSON.parse((event as MessageEvent).data)))
  stream.onerror = () => lost(true)
  stream.onopen = () => lost(false)
  addEventListener('pagehide', () => {
    stream.close()
    navigator.sendBeacon(`api/leave?${query({ tab })}`)
  })
}

export function download(path: string, name: string) {
  const link = document.createElement('a')
  link.href = path
  link.download = name
  link.click()
}

export function downloadBlob(blob: Blob, name: string) {
  const address = URL.createObjectURL(blob)
  download(address, name)
  setTimeout(() => URL.revokeObjectURL(address), 60000)
}
