// What a person drops or chooses, sorted into what the studio can take; the rest is told at once, before it travels.
import { app } from './app'
import { size } from './ui/parts'

export interface Sorted {
  meshes: File[]
  markers: File[]
  projects: File[] // a copy (.zip) or a project's .json
}

export const markerEndings = ['.csv', '.pp', '.fcsv', '.mrk.json', '.json', '.pts', '.tps', '.txt', '.dta', '.landmarkascii']
const ends = (file: File, endings: string[]) => endings.some((ending) => file.name.toLowerCase().endsWith(ending))
export const isMesh = (file: File) => ends(file, app.state?.mesh_formats ?? [])

// Why a file cannot be taken; nothing where it can.
function problem(file: File): string | undefined {
  const meshes = (app.state?.mesh_formats ?? []).join(' ')
  const limit = app.state?.most_upload ?? Infinity
  if (file.type.startsWith('image/') || ends(file, ['.tga', '.tif', '.tiff', '.exr', '.hdr']))
    return `${file.name} is a picture. Drop a model (${meshes}), markers or a project.`
  if (file.type.startsWith('video/') || file.type.startsWith('audio/')) return `${file.name} is no model. The studio reads ${meshes}.`
  if (ends(file, ['.mtl'])) return `${file.name} holds materials, which the studio does not show. Drop the model alone.`
  if (!isMesh(file) && !ends(file, [...markerEndings, '.zip']))
    return `${file.name} is nothing that the studio reads: models are ${meshes}; markers ${markerEndings.slice(0, 7).join(' ')}.`
  if (file.size > limit)
    return `${file.name} has ${size(file.size)}; through the page go ${size(limit)} at most. Name it on the command line instead: meshtween studio SOURCE TARGET`
  if (!isMesh(file) && !ends(file, ['.zip']) && file.size > 16 << 20) return `${file.name} has ${size(file.size)}, too much for a file of markers.`
  if (file.size === 0) return `${file.name} is empty.`
  return undefined
}

// The files of a drop; folders are told of. To be called while the event is handled: later the browser knows no more.
export function dropped(event: DragEvent): File[] {
  const items = [...(event.dataTransfer?.items ?? [])].filter((item) => item.kind === 'file')
  const files: File[] = []
  for (const item of items) {
    const entry = item.webkitGetAsEntry?.()
    const file = item.getAsFile()
    if (entry?.isDirectory) app.toast(`${entry.name} is a folder. Open it, and drop the files that are in it.`, true)
    else if (file) files.push(file)
  }
  return files
}

export async function sortOut(files: File[]): Promise<Sorted> {
  const sorted: Sorted = { meshes: [], markers: [], projects: [] }
  for (const file of files) {
    const why = problem(file)
    if (why) app.toast(why, true)
    else if (isMesh(file)) sorted.meshes.push(file)
    else if (ends(file, ['.zip'])) sorted.projects.push(file)
    else if (ends(file, ['.json']) && (await file.text()).includes('"meshtween_project"')) sorted.projects.push(file)
    else sorted.markers.push(file)
  }
  return sorted
}
