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

// The faces, vertices and edges that a sentence names by number: "face 4", "edge 12-47 belongs to three faces (5, 9 and
// 11)". A number before the word is a count.
function elementsIn(text: string): { at: number; text: string; what: string; number: number }[] {
  const found: { at: number; text: string; what: string; number: number }[] = []
  let kind = ''
  const word = /\b(face|triangle|edge)s?\b|\b(vertex|vertices)\b|(?<![\d.-]|lines? )\b(\d+)(?:-\d+)?\b(?![.\d]*\d| ?%| (?:faces|triangles|edges|vertices|more|pairs|of)\b)/g
  for (const match of text.matchAll(word)) {
    if (match[1] || match[2]) kind = match[2] || match[1] === 'edge' ? 'vertex' : 'face'
    else if (kind) found.push({ at: match.index!, text: match[0], what: kind, number: Number(match[3]) })
  }
  return found
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
    for (const { at, text: shown, what, number } of elementsIn(text)) {
      const place = placeNamed(side, what, number)
      if (place) marks.push({ at, text: shown, show: () => (app.shown.add(side), app.changed(), flyTo(side, place, 0.35)) })
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
