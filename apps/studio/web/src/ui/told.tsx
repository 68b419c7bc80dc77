// What was said of files, and what a sentence names, as things to click.
import { app } from '../app'
import { placeNamed, flyTo, flyToMarker, select } from '../placing'
import type { Side } from '../types'
import { Button } from './parts'

type Piece = string | { text: string; show: () => void }

// A name of letters stands alone; one that begins or ends with another sign needs no such border.
const border = /[\p{L}\p{N}_]/u
function standsAlone(text: string, at: number, name: string): boolean {
  const clash = (inner: string, outer: string | undefined) => outer !== undefined && border.test(inner) && border.test(outer)
  return !clash(name[0], text[at - 1]) && !clash(name.at(-1)!, text[at + name.length])
}

// The markers' names in a sentence. A number alone is a name only between quotes or in a list in brackets.
function markersIn(text: string): { at: number; name: string; id: string }[] {
  const found: { at: number; name: string; id: string }[] = []
  const named = app.store.document.markers.filter(({ name }) => name.trim() !== '').sort((a, b) => b.name.length - a.name.length)
  for (const { id, name } of named) {
    for (let at = text.indexOf(name); at >= 0; at = text.indexOf(name, at + name.length)) {
      const plain = /^[\d.]+$|^.$/.test(name) && !/['"“(]$|\(.*, $/.test(text.slice(0, at))
      const taken = found.some((other) => at < other.at + other.name.length && other.at < at + name.length)
      if (!plain && !taken && standsAlone(text, at, name)) found.push({ at, name, id })
    }
  }
  return found.sort((a, b) => a.at - b.at)
}

function pieces(text: string, side?: Side): Piece[] {
  const marks: { at: number; text: string; show: () => void }[] = markersIn(text).map(({ at, name, id }) => ({
    at,
    text: name,
    show: () => {
      app.set({ step: 'markers' })
      select(id)
      flyToMarker(id)
    },
  }))
  if (side && app.models[side])
    for (const found of text.matchAll(/\b(vertex|face|triangle) (\d+)\b/g)) {
      const at = placeNamed(side, found[1], Number(found[2]))
      if (at) marks.push({ at: found.index!, text: found[0], show: () => (app.shown.add(side), app.changed(), flyTo(side, at, 0.35)) })
    }
  marks.sort((a, b) => a.at - b.at)
  const list: Piece[] = []
  let from = 0
  for (const mark of marks) {
    if (mark.at < from) continue
    list.push(text.slice(from, mark.at), mark)
    from = mark.at + mark.text.length
  }
  return [...list, text.slice(from)]
}

export function Linked({ text, side }: { text: string; side?: Side }) {
  return (
    <>
      {pieces(text, side).map((piece, i) =>
        typeof piece === 'string' ? (
          piece
        ) : (
          <button type="button" class="link" key={i} title="Show it" onClick={piece.show}>
            {piece.text}
          </button>
        ),
      )}
    </>
  )
}

// Notes stay until they are put away: a person reads them while mending what they are about.
export function ToldNotes() {
  return (
    <>
      {app.told.map(({ from, notes }) => (
        <div class="note" role="status" key={from}>
          <header>
            <b>{from}</b>
            <Button small label={`put away what was said of ${from}`} title="Put this away" onClick={() => app.tell(from, [])}>
              ×
            </Button>
          </header>
          {notes.map((note) => (
            <p key={note}>
              <Linked text={note} />
            </p>
          ))}
        </div>
      ))}
    </>
  )
}
