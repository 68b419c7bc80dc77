// The document's markers, and suggestions, as pins in the views, and the plane of symmetry.
import { app } from './app'
import { isComplete } from './edits'
import { ghosts } from './placing'
import type { Pin } from './scene/pins'
import { sides } from './types'

const complete: [number, number, number] = [0.11, 0.42, 0.9]
const half: [number, number, number] = [0.82, 0.47, 0.02]
const locked: [number, number, number] = [0.38, 0.44, 0.52]
const chosen: [number, number, number] = [0.85, 0.12, 0.42]
const ghost: [number, number, number] = [0.85, 0.12, 0.42]

let shownFor: unknown[] = []

export function showPins() {
  const { document } = app.store
  // Only where something has changed: this runs with every drawing of the page.
  const now = [document.markers, document.symmetry, app.selected, ghosts.list, app.state, app.models.source, app.models.target, app.step]
  if (now.every((value, i) => value === shownFor[i])) return
  shownFor = now
  for (const side of sides) {
    const frame = app.info(side)?.frame
    const pins: Pin[] = []
    document.markers.forEach((marker, i) => {
      const at = marker[side]
      if (!at || !frame || app.step === 'morph' || app.step === 'export') return
      const mine = marker.id === app.selected
      const color = mine ? chosen : marker.locked ? locked : isComplete(marker) ? complete : half
      const size = mine ? 13 : app.step === 'markers' ? 10 : 7
      pins.push({ id: marker.id, number: app.step === 'markers' || mine ? i + 1 : 0, at: app.toDrawn(at, frame), color, size, ghost: false })
    })
    for (const one of ghosts.list)
      if (one.side === side && frame)
        pins.push({ id: 'ghost', number: 0, at: app.toDrawn(one.at, frame), color: ghost, size: 13, ghost: true })
    app.pane(side).pins.show(pins)
    app.pane(side).glass.show(document.symmetry.on && app.step === 'markers' ? document.symmetry.axis : null, document.symmetry[side])
  }
  app.stage.draw()
}
