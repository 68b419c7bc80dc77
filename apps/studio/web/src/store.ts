// The document and its history. There is one kind of command: an edit, which holds the document before and after it.
import type { Document, Side } from './types'

interface Edit {
  label: string
  before: Document
  after: Document
  key?: string // edits in a row with one key (a drag) become one
}

const longestHistory = 100 // edits that outlive a reload

export const emptyDocument = (): Document => ({
  models: { source: null, target: null },
  markers: [],
  symmetry: { on: false, axis: 0, source: 0, target: 0 },
  timing: { dabs: [] },
  options: { fit: {}, morph: {} },
})

// Text that is the same for the same values, whatever the order of their names.
const inOrder = (value: unknown) =>
  JSON.stringify(value, (_, inner) =>
    inner && typeof inner === 'object' && !Array.isArray(inner)
      ? Object.fromEntries(Object.entries(inner).sort(([a], [b]) => (a < b ? -1 : 1)))
      : inner,
  )

// Documents share most of their parts, so each part is written once and named by its number.
type Packed = { markers: number[]; dabs: number[]; rest: number }

class Packer {
  documents: Packed[] = []
  parts: unknown[] = []
  private numbers = new Map<unknown, number>()

  private part(value: unknown, key: unknown = value): number {
    const known = this.numbers.get(key)
    if (known !== undefined) return known
    this.numbers.set(key, this.parts.length)
    return this.parts.push(value) - 1
  }

  pack(document: Document): number {
    const known = this.numbers.get(document)
    if (known !== undefined) return known
    const { markers, timing, ...rest } = document
    const text = JSON.stringify(rest)
    this.numbers.set(document, this.documents.length)
    return this.documents.push({ markers: markers.map((marker) => this.part(marker)), dabs: timing.dabs.map((dab) => this.part(dab)), rest: this.part(rest, text) }) - 1
  }
}

const unpack = (documents: Packed[], parts: any[]): Document[] =>
  documents.map(({ markers, dabs, rest }) => ({ ...parts[rest], markers: markers.map((i) => parts[i]), timing: { dabs: dabs.map((i) => parts[i]) } }))

// A model that has another hash than before in the same file has changed on disk: what it was before is not there any
// more, and what can be undone is of what it is now.
const ofToday = (document: Document, now: Document): Document => {
  const today = (side: Side) => (document.models[side]?.path === now.models[side]?.path ? now.models[side] : document.models[side])
  return { ...document, models: { source: today('source'), target: today('target') } }
}

export class Store {
  document = emptyDocument()
  private past: Edit[] = []
  private future: Edit[] = []
  private last: 'edit' | 'undo' | 'redo' = 'edit'
  private listeners = new Set<(edited: boolean) => void>()

  // Calls back with whether a person changed the document; else it came from the program.
  subscribe(listener: (edited: boolean) => void) {
    this.listeners.add(listener)
  }

  // Documents are never changed in place: `change` returns a new one that shares what stayed the same.
  edit(label: string, change: (document: Document) => Document, key?: string) {
    const before = this.document
    const after = change(before)
    if (after === before) return
    const last = this.past.at(-1)
    if (key && last?.key === key && last.after === before) last.after = after
    else this.past.push({ label, before, after, key })
    this.future = []
    this.last = 'edit'
    this.show(after)
  }

  // Ends a row of edits with one key.
  seal() {
    const last = this.past.at(-1)
    if (last) last.key = undefined
  }

  undo(): string | undefined {
    const edit = this.past.pop()
    if (!edit) return undefined
    this.future.push(edit)
    this.last = 'undo'
    this.show(edit.before)
    return edit.label
  }

  redo(): string | undefined {
    const edit = this.future.pop()
    if (!edit) return undefined
    this.past.push(edit)
    this.last = 'redo'
    this.show(edit.after)
    return edit.label
  }

  // Takes back the last edit, undo or redo as if it had not been made.
  takeBack() {
    if (this.last === 'undo') return void this.redo()
    if (this.last === 'redo') return void this.undo()
    const edit = this.past.pop()
    if (edit) this.show(edit.before)
  }

  get undoLabel() {
    return this.past.at(-1)?.label
  }
  get redoLabel() {
    return this.future.at(-1)?.label
  }

  // Another document altogether: what was undone belongs to the old one.
  replace(document: Document) {
    this.past = []
    this.future = []
    this.show(document, false)
  }

  // What can be undone and done again, for whoever goes on with this document.
  history(): string {
    const packer = new Packer()
    const pack = (edits: Edit[]) =>
      edits.slice(-longestHistory).map(({ label, before, after }) => ({ label, before: packer.pack(before), after: packer.pack(after) }))
    const of = packer.pack(this.document)
    return JSON.stringify({ of, past: pack(this.past), future: pack(this.future), documents: packer.documents, parts: packer.parts })
  }

  // Takes up a history. Where its last word is not this document, it was written a moment earlier: one more edit.
  recall(history: string) {
    const told = JSON.parse(history)
    if (!told?.documents) return
    const documents = unpack(told.documents, told.parts).map((document) => ofToday(document, this.document))
    const edits = (list: { label: string; before: number; after: number }[]): Edit[] =>
      list.map(({ label, before, after }) => ({ label, before: documents[before], after: documents[after] }))
    this.past = edits(told.past)
    this.future = edits(told.future)
    if (inOrder(documents[told.of]) === inOrder(this.document)) return
    this.past.push({ label: 'the last change', before: documents[told.of], after: this.document })
    this.future = []
  }

  private show(document: Document, edited = true) {
    this.document = document
    for (const listener of this.listeners) listener(edited)
  }
}
