// Sends every change of the document to the program, one request at a time, the newest document always last; and, when
// it has gone quiet, what can be undone.
import { api } from './api'
import type { Store } from './store'
import type { Document } from './types'

export type Saved = 'saved' | 'saving' | 'failed'

const quiet = 300 // milliseconds

export class Saver {
  state: Saved = 'saved'
  problem = ''
  private waiting: Document | null = null
  private running: Promise<void> | null = null
  private historyWaits = 0

  // `project` is the number of the project that is open: a change that comes late is not written into another one.
  constructor(private store: Store, private project: () => number, private changed: () => void, private failed: (document: Document, problem: string) => void) {}

  queue(document: Document) {
    this.waiting = document
    this.state = 'saving'
    this.running ??= this.run()
    clearTimeout(this.historyWaits)
    this.historyWaits = window.setTimeout(() => void this.saveHistory(), quiet)
  }

  // Whether everything that was queued has been written, or has failed.
  get idle() {
    return !this.waiting && !this.running
  }

  // Resolves when it is so; where the project is left, with what can be undone.
  async flush(leaving = false) {
    await this.running
    if (leaving && this.historyWaits) await this.saveHistory()
  }

  private async saveHistory() {
    clearTimeout(this.historyWaits)
    this.historyWaits = 0
    await this.running
    await api.saveHistory(this.store.history()).catch(() => {}) // the document itself is safe
  }

  private async run() {
    await Promise.resolve() // several changes of one moment become one request
    while (this.waiting) {
      const document = this.waiting
      this.waiting = null
      try {
        await api.save(document, this.project())
        this.state = 'saved'
        this.problem = ''
      } catch (error) {
        this.state = 'failed'
        this.problem = (error as Error).message
        this.failed(document, this.problem)
      }
      this.changed()
    }
    this.running = null
  }
}
