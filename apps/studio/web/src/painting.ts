// Painting when each part of the source moves: a stroke is one edit of the document.
import { Vector3 } from 'three'
import { app } from './app'
import type { Hit } from './scene/pane'
import { heatColors } from './scene/heat'
import type { Dab, Side } from './types'

let painted = false // the source is drawn in the colours of its timing
let stroke: { key: string; last: Vector3 } | null = null
let strokes = 0

// Whether a drag that begins here paints.
export function begin(side: Side, hit: Hit | null): boolean {
  if (side !== 'source' || app.step !== 'morph' || !app.brush.on || !hit || app.readOnly) return false
  stroke = { key: `stroke ${++strokes}`, last: new Vector3(Infinity, 0, 0) }
  paint(hit)
  return true
}

// Adds a dab where the brush has moved on; whether a stroke is being made.
export function paint(hit: Hit): boolean {
  if (!stroke) return false
  const { radius, start, end } = app.brush
  if (stroke.last.distanceTo(hit.point) < radius / 2) return true
  stroke.last.copy(hit.point)
  const dab: Dab = { at: app.fromDrawn(hit.point, app.info('source')!.frame), radius, start, end }
  app.store.edit('paint the timing', (d) => ({ ...d, timing: { dabs: [...d.timing.dabs, dab] } }), stroke.key)
  return true
}

export function end(): boolean {
  if (!stroke) return false
  stroke = null
  app.store.seal()
  return true
}

export function change(values: Partial<typeof app.brush>) {
  app.set({ brush: { ...app.brush, ...values } })
  if (app.brush.on) app.shown.add('source')
  show()
}

export function clear() {
  app.store.edit('clear the timing', (d) => (d.timing.dabs.length > 0 ? { ...d, timing: { dabs: [] } } : d))
}

// The source in the colours of the moments at which its parts begin, while there is a brush.
export function show() {
  const model = app.models.source
  if (!model) return
  if (!app.brush.on || app.step !== 'morph') {
    if (painted) model.setColors(app.shading === 'colour' ? model.colors : null)
    painted = false
  } else {
    painted = true
    model.setColors(heatColors(starts(app.store.document.timing.dabs), 0, 1))
  }
  app.stage.draw()
}

// The moment at which each vertex begins; a new dab after those known costs no more than itself.
let known: { dabs: Dab[]; frame: unknown; values: Float32Array } = { dabs: [], frame: null, values: new Float32Array() }

function starts(dabs: Dab[]): Float32Array {
  const positions = app.models.source!.geometry.getAttribute('position').array
  const frame = app.info('source')!.frame
  const more = known.frame === frame && known.values.length * 3 === positions.length && known.dabs.every((dab, i) => dab === dabs[i])
  const values = more ? known.values : new Float32Array(positions.length / 3)
  for (const dab of dabs.slice(more ? known.dabs.length : 0)) {
    const { x, y, z } = app.toDrawn(dab.at, frame)
    for (let i = 0; i < values.length; ++i) {
      const [dx, dy, dz] = [positions[3 * i] - x, positions[3 * i + 1] - y, positions[3 * i + 2] - z]
      if (dx * dx + dy * dy + dz * dz <= dab.radius * dab.radius) values[i] = dab.start
    }
  }
  known = { dabs, frame, values }
  return values
}
