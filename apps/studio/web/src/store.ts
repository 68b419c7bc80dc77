// The document and its history. There is one kind of command: an edit, which holds the document before and after it.
import type { Document } from './types'

interface Edit {
  label: string
  before: Document
  after: Document
  key?: string // edits in a row with one key (a drag) become one
}

const longestHistory = 100 // edits that outlive a reload

export const emptyDocument = (): Document => ({
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

  // What can be undone and done again, for whoever goes on with this document.
  history(): string {
    const sealed = (edits: Edit[]) => edits.slice(-longestHistory).map((edit) => ({ ...edit, key: undefined }))
    return JSON.stringify({ of: this.document, past: sealed(this.past), future: sealed(this.future) })
  }

  // Takes up a history where it is of this very document.
  recall(history: string) {
    const { of, past, future } = JSON.parse(history)
    if (inOrder(of) !== inOrder(this.document)) return
    this.past = past
    this.future = future
  }

  private show(document: Document, edited = true) {
    this.document = document
    for (const listener of this.listeners) listener(edited)
  }
}
