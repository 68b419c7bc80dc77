// The program behind the page. All addresses are relative: the token is part of the page's own.
import type { Document, Side, State, Vec3 } from './types'

export const tab = crypto.randomUUID()

export class Refused extends Error {}

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

export async function bytes(path: string, values: Record<string, string | number> = {}): Promise<ArrayBuffer> {
  return (await ask(`${path}?${query(values)}`)).arrayBuffer()
}

export const api = {
  state: () => get<State>('api/state'),
  changes: () => get<Record<Side, boolean>>('api/changes'),
  save: (document: Document) => post('api/document', JSON.stringify(document)),
  upload: (side: Side, file: File) => post(`api/upload?${query({ side, name: file.name })}`, file),
  reload: (side: Side) => post(`api/reload?${query({ side })}`),
  sample: (name: string, markers: boolean) => post(`api/sample?${query({ name, markers: markers ? 'yes' : 'no' })}`),
  openProject: (text: string) => post('api/project', text),
  newProject: () => post('api/new'),
  fit: (options: unknown) => post('api/fit', JSON.stringify(options)),
  morph: (request: unknown) => post('api/morph', JSON.stringify(request)),
  export: (request: unknown) => post('api/export', JSON.stringify(request)),
  cancel: () => post('api/cancel'),
  takeOver: () => post(`api/take-over?${query({ tab })}`),
  guess: (from: Side, points: Vec3[]) => post<Vec3[]>(`api/guess?${query({ from })}`, JSON.stringify(points)),
  suggestions: () => get<{ at: Vec3; why: string; target?: Vec3 }[]>('api/suggestions'),
  importMarkers: (files: File[]) =>
    post<{ pairs: { name: string; source: Vec3; target: Vec3 }[]; notes: string[] }>(
      `api/markers/import?${query(
        files.length === 2
          ? { name: files[0].name, second: files[1].name, first: files[0].size }
          : { name: files[0].name },
      )}`,
      new Blob(files),
    ),
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
