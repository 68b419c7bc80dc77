// What clicks and keys do to markers. Every change is one edit of the document.
import { Vector3 } from 'three'
import { api } from './api'
import { app } from './app'
import { add, find, isComplete, move, place, remove, update } from './edits'
import type { Hit } from './scene/pane'
import { other, sides, type Marker, type Side, type Vec3 } from './types'

export interface Ghost {
  side: Side
  at: Vec3
}

// Suggestions on the models, taken with one key.
export const ghosts: { list: Ghost[]; why: string; for: string | null } = { list: [], why: '', for: null }

const editable = () => {
  if (app.readOnly) app.toast('Another tab is editing; take over first.', true)
  return !app.readOnly
}

// The point across the symmetry plane, put onto the surface; nothing where the point lies on the plane itself.
export function mirrored(side: Side, at: Vec3): Vec3 | undefined {
  const { on, axis, ...offset } = app.store.document.symmetry
  const info = app.info(side)
  const tree = app.models[side]?.pickingTree
  if (!on || !info || !tree) return undefined
  const drawn = app.toDrawn(at, info.frame)
  const across = drawn.clone().setComponent(axis, 2 * offset[side] - drawn.getComponent(axis))
  if (across.distanceTo(drawn) < 0.02) return undefined
  const found = tree.closestPointToPoint(across)
  return found ? app.fromDrawn(found.point, info.frame) : undefined
}

const pointOf = (side: Side, hit: Hit): Vec3 => app.fromDrawn(app.snap ? hit.corner : hit.point, app.info(side)!.frame)

export function clicked(side: Side, hit: Hit | null, pin: string | null) {
  if (pin) return select(pin)
  if (!hit) return select(null)
  if (app.step !== 'markers' || !editable()) return
  placeAt(side, pointOf(side, hit))
}

// Sets the missing side of the selected marker, or starts a new one.
export function placeAt(side: Side, at: Vec3) {
  const { store } = app
  const selected = find(store.document, app.selected)
  const mirror = mirrored(side, at)
  if (selected && selected[side] === null && !selected.locked) {
    store.edit(`place ${selected.name} on the ${side}`, (d) => place(d, selected.id, side, at, mirror))
  } else {
    let id = ''
    store.edit('add a marker', (d) => {
      const added = add(d, { [side]: at }, mirror && { [side]: mirror })
      id = added.id
      return added.after
    })
    app.selected = id
  }
  void suggestOther()
}

export function select(id: string | null) {
  app.set({ selected: id })
  void suggestOther()
}

export function selectNext(by: number) {
  const { markers } = app.store.document
  if (markers.length === 0) return
  const now = markers.findIndex((marker) => marker.id === app.selected)
  select(markers[(now + by + markers.length + (now < 0 && by < 0 ? 1 : 0)) % markers.length].id)
  flyToMarker(app.selected!)
}

// Only the selected marker can be dragged, and only where it is not locked: nothing moves by accident.
export function mayDrag(id: string | null): boolean {
  const marker = find(app.store.document, id)
  return app.step === 'markers' && id === app.selected && !!marker && !marker.locked && !app.readOnly
}

export function dragged(side: Side, hit: Hit) {
  const marker = find(app.store.document, app.selected)
  if (!marker) return
  const at = pointOf(side, hit)
  app.store.edit(`move ${marker.name}`, (d) => place(d, marker.id, side, at, mirrored(side, at)), `${marker.id} ${side}`)
}

export function dropped() {
  app.store.seal()
}

export function removeSelected() {
  const marker = find(app.store.document, app.selected)
  if (!marker || !editable()) return
  if (marker.locked) return app.toast(`${marker.name} is locked.`)
  app.store.edit(`delete ${marker.name}`, (d) => remove(d, marker.id))
  select(null)
}

export function change(marker: Marker, label: string, values: Partial<Marker>) {
  if (editable()) app.store.edit(label, (d) => update(d, marker.id, values))
}

// A name tells markers apart, in the table and in files: it is neither empty nor another's.
export function rename(marker: Marker, text: string) {
  const name = text.trim().replace(/\s+/g, ' ')
  const other = app.store.document.markers.find((one) => one.id !== marker.id && one.name === name)
  if (name === '') return app.toast(`A marker needs a name; this one is still “${marker.name}”.`, true)
  if (other) return app.toast(`Another marker is called “${name}”; this one is still “${marker.name}”.`, true)
  if (name !== marker.name) change(marker, `rename ${marker.name}`, { name })
}

export function reorder(marker: Marker, by: number) {
  if (editable()) app.store.edit(`reorder ${marker.name}`, (d) => move(d, marker.id, by))
}

export function undo() {
  if (!editable()) return
  const label = app.store.undo()
  app.toast(label ? `Undone: ${label}` : 'There is nothing to undo.')
  forgetLost()
}

export function redo() {
  if (!editable()) return
  const label = app.store.redo()
  app.toast(label ? `Done again: ${label}` : 'There is nothing to do again.')
  forgetLost()
}

function forgetLost() {
  if (!find(app.store.document, app.selected)) app.selected = null
  void suggestOther()
}

export function flyToMarker(id: string) {
  const marker = find(app.store.document, id)
  for (const side of sides) {
    const at = marker?.[side]
    if (at) flyTo(side, at, 0.7)
  }
}

export function flyTo(side: Side, at: Vec3, distance: number) {
  const drawn = app.toDrawn(at, app.info(side)?.frame)
  app.pane(side).flyTo(drawn, distance, facing(side, drawn))
}

// The place of a vertex or a face that a sentence names by its number; nothing where there is none.
export function placeNamed(side: Side, what: string, number: number): Vec3 | undefined {
  const geometry = app.models[side]?.geometry
  const frame = app.info(side)?.frame
  const positions = geometry?.getAttribute('position')
  if (!geometry?.index || !positions || !frame) return undefined
  const at = new Vector3()
  if (what === 'vertex') {
    if (number >= positions.count) return undefined
    at.fromBufferAttribute(positions, number)
  } else {
    if (3 * number + 2 >= geometry.index.count) return undefined
    for (let k = 0; k < 3; ++k) at.add(new Vector3().fromBufferAttribute(positions, geometry.index.getX(3 * number + k)))
    at.divideScalar(3)
  }
  return app.fromDrawn(at, frame)
}

// The surface's direction at a point: where to look at it from.
export function facing(side: Side, drawn: Vector3): Vector3 | undefined {
  const model = app.models[side]
  const found = model?.pickingTree?.closestPointToPoint(drawn)
  if (!model || !found) return undefined
  const index = model.geometry.index!
  const corner = (k: number) => new Vector3().fromBufferAttribute(model.geometry.getAttribute('position'), index.getX(3 * found.faceIndex + k))
  const [a, b, c] = [corner(0), corner(1), corner(2)]
  return b.sub(a).cross(c.sub(a)).normalize()
}

// A ghost where the selected marker's missing side probably lies.
export async function suggestOther() {
  Object.assign(ghosts, { list: [], why: '', for: null })
  app.changed()
  const marker = find(app.store.document, app.selected)
  if (!marker || isComplete(marker) || marker.locked || (!marker.source && !marker.target)) return
  if (!app.info('source') || !app.info('target')) return
  const from: Side = marker.source ? 'source' : 'target'
  await app.saver.flush()
  const [at] = (await api.guess(from, [marker[from]!]).catch(() => [])) as Vec3[]
  if (!at || app.selected !== marker.id) return
  Object.assign(ghosts, {
    list: [{ side: other(from), at }],
    why: `Guess on the ${other(from)}: Enter accepts it, or click the place.`,
    for: marker.id,
  })
  app.changed()
}

// The next place worth a marker, with its guess on the target.
export async function suggestNext() {
  await app.attempt(async () => {
    await app.saver.flush()
    const [best] = await api.suggestions()
    if (!best) return
    const at = best.target ?? (await api.guess('source', [best.at]))[0]
    app.selected = null
    Object.assign(ghosts, {
      list: [{ side: 'source', at: best.at }, { side: 'target', at }],
      why: `Place the next one here: ${best.why}. Enter accepts both, or click better places.`,
      for: null,
    })
    flyTo('source', best.at, 1)
    if (!app.linked) flyTo('target', at, 1)
    app.changed()
  })
}

export function acceptGhosts(): boolean {
  if (ghosts.list.length === 0 || !editable()) return false
  const points = Object.fromEntries(ghosts.list.map(({ side, at }) => [side, at])) as Partial<Record<Side, Vec3>>
  const marker = find(app.store.document, ghosts.for)
  if (marker) {
    const { side, at } = ghosts.list[0]
    app.store.edit(`accept the guess for ${marker.name}`, (d) => place(d, marker.id, side, at, mirrored(side, at)))
  } else {
    const across = Object.fromEntries(
      ghosts.list.map(({ side, at }) => [side, mirrored(side, at)]).filter(([, at]) => at),
    ) as Partial<Record<Side, Vec3>>
    app.store.edit('accept a suggestion', (d) => {
      const added = add(d, points, Object.keys(across).length ? across : undefined)
      app.selected = added.id
      return added.after
    })
  }
  void suggestOther()
  return true
}
