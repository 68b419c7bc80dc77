// Sends every change of the document to the program, one request at a time, the newest document always last.
import { api } from './api'
import type { Document } from './types'

export type Saved = 'saved' | 'saving' | 'failed'

export class Saver {
  state: Saved = 'saved'
  problem = ''
  private waiting: Document | null = null
  private running: Promise<void> | null = null

  constructor(private changed: () => void) {}

  queue(document: Document) {
    this.waiting = document
    this.state = 'saving'
    this.running ??= this.run()
  }

  // Resolves when everything queued has been written, or has failed.
  async flush() {
    await this.running
  }

  private async run() {
    await Promise.resolve() // several changes of one moment become one request
    while (this.waiting) {
      const document = this.waiting
      this.waiting = null
      try {
        await api.save(document)
        this.state = 'saved'
        this.problem = ''
      } catch (error) {
        this.state = 'failed'
        this.problem = (error as Error).message
      }
      this.changed()
    }
    this.running = null
  }
}
