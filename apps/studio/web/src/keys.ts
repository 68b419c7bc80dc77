// Every command has a key; this table is also what the help sheet shows.
import { api } from './api'
import { app, type Step } from './app'
import { find } from './edits'
import * as painting from './painting'
import * as placing from './placing'
import { sides } from './types'
import { play, player, paths, seek, startFit } from './work'
import { frameAll, toggleLinked, togglePane, toggleWires } from './ui/views'

interface Command {
  keys: string[] // as shown; matched by name
  what: string
  group: string
  run: () => void | boolean // false: the key was not for this command
}

const steps: Step[] = ['open', 'markers', 'fit', 'morph', 'export']

// Where a marker is set by key: the middle of the view that has the focus.
function placeInMiddle(move: boolean): boolean {
  const side = sides.find((one) => app.pane(one).element === document.activeElement)
  if (!side || app.step !== 'markers' || app.readOnly) return false
  const hit = app.pane(side).hit()
  if (!hit) return true
  const marker = find(app.store.document, app.selected)
  if (move && marker && !marker.locked) {
    placing.dragged(side, hit)
    placing.dropped()
  } else placing.clicked(side, hit, null)
  return true
}

const selectedMarker = () => find(app.store.document, app.selected)

export const commands: Command[] = [
  { keys: ['Ctrl+Z'], what: 'Undo', group: 'Always', run: placing.undo },
  { keys: ['Ctrl+Shift+Z', 'Ctrl+Y'], what: 'Redo', group: 'Always', run: placing.redo },
  { keys: ['Alt+1', 'Alt+2', 'Alt+3', 'Alt+4', 'Alt+5'], what: 'Models, markers, fit, morph, export', group: 'Always', run: () => false },
  { keys: ['Escape'], what: 'Cancel the job; deselect', group: 'Always', run: () => {
    if (app.helpOpen) return app.set({ helpOpen: false })
    if (app.running) return void app.attempt(() => api.cancel())
    placing.select(null)
  } },
  { keys: ['?'], what: 'This sheet', group: 'Always', run: () => app.set({ helpOpen: !app.helpOpen }) },
  { keys: ['Insert', 'M'], what: 'Place a marker in the middle of the focused view', group: 'Markers', run: () => placeInMiddle(false) },
  { keys: ['Shift+M'], what: 'Move the selected marker to the middle of the view', group: 'Markers', run: () => placeInMiddle(true) },
  { keys: ['Enter'], what: 'Accept the suggestion', group: 'Markers', run: () => placing.acceptGhosts() },
  { keys: ['N'], what: 'Suggest the next place', group: 'Markers', run: () => void placing.suggestNext() },
  { keys: ['J'], what: 'Next marker', group: 'Markers', run: () => placing.selectNext(1) },
  { keys: ['K'], what: 'Previous marker', group: 'Markers', run: () => placing.selectNext(-1) },
  { keys: ['F'], what: 'Show the selected marker', group: 'Markers', run: () => { if (app.selected) placing.flyToMarker(app.selected) } },
  { keys: ['Delete', 'X'], what: 'Delete the selected marker', group: 'Markers', run: placing.removeSelected },
  { keys: ['Alt+ArrowUp'], what: 'Up in the list', group: 'Markers', run: () => { const m = selectedMarker(); if (m) placing.reorder(m, -1) } },
  { keys: ['Alt+ArrowDown'], what: 'Down in the list', group: 'Markers', run: () => { const m = selectedMarker(); if (m) placing.reorder(m, 1) } },
  { keys: ['S'], what: 'Snap to vertices on and off', group: 'Markers', run: () => app.set({ snap: !app.snap }) },
  { keys: ['1'], what: 'Show or hide the source', group: 'Views', run: () => togglePane('source') },
  { keys: ['2'], what: 'Show or hide the target', group: 'Views', run: () => togglePane('target') },
  { keys: ['3'], what: 'Show or hide the result', group: 'Views', run: () => togglePane('result') },
  { keys: ['W'], what: 'Wires', group: 'Views', run: toggleWires },
  { keys: ['L'], what: 'Match view: all turn alike', group: 'Views', run: toggleLinked },
  { keys: ['Home'], what: 'Frame the whole models', group: 'Views', run: frameAll },
  { keys: ['Ctrl+Enter'], what: 'Fit', group: 'Fit and morph', run: () => { app.set({ step: 'fit' }); if (!app.running) void startFit() } },
  { keys: ['Space'], what: 'Play or pause', group: 'Fit and morph', run: () => (paths.main ? play(!player.playing) : false) },
  { keys: ['B'], what: 'The timing brush on and off', group: 'Fit and morph', run: () => (app.step === 'morph' ? painting.change({ on: !app.brush.on }) : false) },
  { keys: [','], what: 'A step towards the source', group: 'Fit and morph', run: () => seek(player.u - 0.02) },
  { keys: ['.'], what: 'A step towards the target', group: 'Fit and morph', run: () => seek(player.u + 0.02) },
]

const nameOf = (event: KeyboardEvent) => {
  const key = event.key === ' ' ? 'Space' : event.key.length === 1 && /[a-z]/i.test(event.key) ? event.key.toUpperCase() : event.key
  const shift = event.shiftKey && /^[A-Z]$/.test(key)
  return `${event.ctrlKey || event.metaKey ? 'Ctrl+' : ''}${event.altKey ? 'Alt+' : ''}${shift ? 'Shift+' : ''}${key}`
}

export function listenToKeys() {
  window.addEventListener('keydown', (event: KeyboardEvent) => {
    const inField = event.target instanceof Element && event.target.closest('input:not([type=checkbox]):not([type=range]), select, textarea')
    const name = nameOf(event)
    if (app.question) {
      if (name === 'Escape') app.question.answer(null)
      return
    }
    if (app.busy?.stop && name === 'Escape') return app.busy.stop()
    const step = /^Alt\+([1-5])$/.exec(name)
    if (step) {
      event.preventDefault()
      return app.set({ step: steps[Number(step[1]) - 1] })
    }
    // Fields keep their keys, undo among them; a list of choices has no undo of its own. A focused button keeps its
    // Enter and Space.
    const undoes = /^Ctrl\+(Shift\+)?[ZY]$/.test(name) && event.target instanceof HTMLSelectElement
    if (inField && !undoes && name !== 'Escape') return
    const onControl = event.target instanceof Element && event.target.closest('button, summary, a, input')
    if (onControl && (name === 'Enter' || name === 'Space')) return
    const command = commands.find((one) => one.keys.includes(name))
    if (!command || command.run() === false) return
    event.preventDefault()
  })
}
