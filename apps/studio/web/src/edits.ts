// Changes of the document as functions from one document to the next.
import type { Document, Examined, ImportedMarker, Marker, Side, Vec3 } from './types'

const withMarkers = (document: Document, markers: Marker[]): Document => ({ ...document, markers })

export const find = (document: Document, id: string | null): Marker | undefined =>
  id === null ? undefined : document.markers.find((marker) => marker.id === id)

export const isComplete = (marker: Marker) => marker.source !== null && marker.target !== null

// Where the complete markers are: a fit is of these places, whatever they are called.
export const placesOf = (document: Document) =>
  JSON.stringify(document.markers.filter(isComplete).map(({ source, target }) => [source, target]))

// Another model on one side: its markers go where they lie on it, and those that lie nowhere become missing.
export function withModel(document: Document, side: Side, { model, carried }: Pick<Examined, 'model' | 'carried'>): Document {
  const places = new Map(carried.map(({ id, at }) => [id, at]))
  const markers = document.markers.map((marker) => (marker[side] ? { ...marker, [side]: places.get(marker.id) ?? null } : marker))
  return { ...document, models: { ...document.models, [side]: model }, markers }
}

export function newId(document: Document): string {
  let number = document.markers.length + 1
  while (document.markers.some((marker) => marker.id === `m${number}`)) ++number
  return `m${number}`
}

function newName(document: Document): string {
  let number = document.markers.length + 1
  while (document.markers.some((marker) => marker.name === `marker ${number}`)) ++number
  return `marker ${number}`
}

export function update(document: Document, id: string, change: Partial<Marker>): Document {
  const markers = document.markers.map((marker) => (marker.id === id ? { ...marker, ...change } : marker))
  return withMarkers(document, markers)
}

// A new marker with what is known of it; with `mirror`, also its twin.
export function add(document: Document, points: Partial<Record<Side, Vec3>>, mirror?: Partial<Record<Side, Vec3>>) {
  const id = newId(document)
  const marker: Marker = {
    id,
    name: newName(document),
    source: points.source ?? null,
    target: points.target ?? null,
    locked: false,
  }
  let after = withMarkers(document, [...document.markers, marker])
  if (mirror) {
    const twin = newId(after)
    after = withMarkers(after, [
      ...after.markers.map((m) => (m.id === id ? { ...m, twin } : m)),
      {
        id: twin,
        name: newName(after),
        source: mirror.source ?? null,
        target: mirror.target ?? null,
        locked: false,
        twin: id,
      },
    ])
  }
  return { after, id }
}

// Sets one side of a marker, and of its twin where there is a mirrored point for it. Locked markers stay.
export function place(document: Document, id: string, side: Side, point: Vec3 | null, mirrored?: Vec3): Document {
  const marker = find(document, id)
  if (!marker || marker.locked) return document
  let after = update(document, id, { [side]: point })
  const twin = find(document, marker.twin ?? null)
  if (twin && !twin.locked && mirrored) after = update(after, twin.id, { [side]: mirrored })
  return after
}

export function remove(document: Document, id: string): Document {
  const gone = find(document, id)
  if (!gone || gone.locked) return document
  const rest = document.markers.filter((marker) => marker.id !== id)
  return withMarkers(
    document,
    rest.map((marker) => (marker.twin === id ? { ...marker, twin: undefined } : marker)),
  )
}

export function move(document: Document, id: string, by: number): Document {
  const from = document.markers.findIndex((marker) => marker.id === id)
  const to = from + by
  if (from < 0 || to < 0 || to >= document.markers.length) return document
  const markers = [...document.markers]
  markers.splice(to, 0, ...markers.splice(from, 1))
  return withMarkers(document, markers)
}

// Markers from a file: one of the same name is set to the places that the file has, unless it is locked; the others are
// new.
export function merge(document: Document, list: ImportedMarker[]) {
  let after = document
  const counts = { added: 0, moved: 0, locked: 0 }
  for (const { name, source, target } of list) {
    const known = document.markers.find((marker) => marker.name === name)
    if (known?.locked) ++counts.locked
    else if (known) (after = update(after, known.id, { source: source ?? known.source, target: target ?? known.target })), ++counts.moved
    else (after = withMarkers(after, [...after.markers, { id: newId(after), name, source, target, locked: false }])), ++counts.added
  }
  return { after, ...counts }
}

export function setOption(document: Document, of: 'fit' | 'morph', name: string, value: number | string): Document {
  return { ...document, options: { ...document.options, [of]: { ...document.options[of], [name]: value } } }
}
