// The document and its history. There is one kind of command: an edit, which holds the document before and after it.
import type { Document } from './types'

interface Edit {
  label: string
  before: Document
  after: Document
  key?: string // edits in a row with one key (a drag) become one
}

export const emptyDocument = (): Document => ({
  markers: [],
  symmetry: { on: false, axis: 0, source: 0, target: 0 },
  timing: { dabs: [] },
  options: { fit: {}, morph: {} },
})

export class Store {
  document = emptyDocument()
  private past: Edit[] = []
  private future: Edit[] = []
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
    this.show(edit.before)
    return edit.label
  }

  redo(): string | undefined {
    const edit = this.future.pop()
    if (!edit) return undefined
    this.past.push(edit)
    this.show(edit.after)
    return edit.label
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

  private show(document: Document, edited = true) {
    this.document = document
    for (const listener of this.listeners) listener(edited)
  }
}
