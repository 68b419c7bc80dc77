// The page's state apart from the document: what is open, shown and selected, and how it comes from the program.
import { Vector3 } from 'three'
import { api, bytes, listen, Refused, Stopped, tab } from './api'
import { Saver } from './save'
import { clay, checker } from './scene/clay'
import { Model, type Shading } from './scene/model'
import type { Pane } from './scene/pane'
import { Stage } from './scene/stage'
import { placesOf } from './edits'
import { emptyDocument, Store } from './store'
import { sides, type Document, type Frame, type Job, type MeshInfo, type Side, type State, type Vec3 } from './types'

export type Step = 'open' | 'markers' | 'fit' | 'morph' | 'export'
export type PaneName = Side | 'result' | 'compare'
export type Heat = 'none' | 'distance' | 'stretch' | 'trust'

// What paints when each part moves.
export interface Brush {
  on: boolean
  radius: number
  start: number
  end: number
}

export interface Toast {
  id: number
  text: string
  bad: boolean
}

// What the page waits for; `part` of it is done, where that is known, and `stop` ends it, where it can be.
export interface Busy {
  text: string
  part?: number
  stop?: () => void
}

// A question over the page. Each choice has its answer; Escape answers nothing.
export interface Question {
  title: string
  lines: string[]
  choices: { label: string; answer: string; primary?: boolean; aside?: string }[]
  answer: (answer: string | null) => void
}

// What was said when a file was read, until it is put away.
export interface Told {
  from: string
  notes: string[]
}

export const documentOf = (told: State['document']): Document => {
  const empty = emptyDocument()
  return {
    models: told.models,
    markers: told.markers,
    symmetry: { ...empty.symmetry, ...told.symmetry },
    timing: { ...empty.timing, ...told.timing },
    options: { fit: told.options.fit ?? {}, morph: told.options.morph ?? {} },
  }
}

class App {
  store = new Store()
  saver = new Saver(this.store, () => this.state?.project.number ?? 0, () => this.changed(), (document, problem) => this.notSaved(document, problem))
  stage = new Stage()
  state: State | null = null
  step: Step = 'open'
  shading: Shading = 'smooth'
  wires = false
  linked = false
  snap = false
  brush: Brush = { on: false, radius: 0.05, start: 0.5, end: 1 }
  selected: string | null = null
  heat: Heat = 'stretch'
  heatMost = 0
  job: Job = {}
  jobBegan = 0 // performance.now()
  editor = '' // the tab that may edit
  lost = false // no word from the program
  busy: Busy | null = null
  question: Question | null = null
  told: Told[] = []
  toasts: Toast[] = []
  helpOpen = false
  fitPlaces: string | null = null // where the markers were that the fit is of
  outside: Record<Side, boolean> = { source: false, target: false } // changed on disk
  models: Record<Side, Model | null> = { source: null, target: null }
  result: Model | null = null
  shown = new Set<PaneName>(['source', 'target'])
  // What follows, set by work.ts.
  jobDone: (job: Job) => void = () => {}
  live: () => void = () => {}
  modelsChanged: () => void = () => {}
  projectChanged: () => void = () => {}
  private loaded: Record<Side, string> = { source: '', target: '' }
  private fitted = ''
  private skin = clay()
  private pattern = checker()
  private listeners = new Set<() => void>()
  private wanted = false

  subscribe(listener: () => void) {
    this.listeners.add(listener)
    return () => this.listeners.delete(listener)
  }

  // Tells the interface, once a moment, that something is different.
  changed() {
    if (this.wanted) return
    this.wanted = true
    queueMicrotask(() => {
      this.wanted = false
      for (const listener of this.listeners) listener()
    })
  }

  set(values: Partial<App>) {
    Object.assign(this, values)
    this.changed()
  }

  get readOnly() {
    return this.editor !== '' && this.editor !== tab
  }
  get running() {
    return this.job.state === 'running'
  }
  // Whether markers were moved, added or taken away after the fit.
  get stale() {
    return this.fitPlaces !== placesOf(this.store.document)
  }
  pane(name: PaneName): Pane {
    return this.stage.panes.get(name)!
  }

  toast(text: string, bad = false) {
    const id = performance.now()
    this.toasts = [...this.toasts.filter((toast) => toast.text !== text), { id, text, bad }].slice(-4)
    setTimeout(() => this.set({ toasts: this.toasts.filter((toast) => toast.id !== id) }), bad ? 12000 : 5000)
    this.changed()
  }

  // Runs what a person asked for; what goes wrong is told, in words that were meant for people.
  async attempt<T>(what: (busy: Busy, signal: AbortSignal) => Promise<T>, text = '', canStop = false): Promise<T | undefined> {
    const control = new AbortController()
    const busy: Busy = { text, stop: canStop ? () => control.abort() : undefined }
    if (text) this.set({ busy })
    try {
      return await what(busy, control.signal)
    } catch (error) {
      if (error instanceof Stopped) this.toast('Stopped. Nothing has changed.')
      else if (error instanceof Refused) this.toast(error.message, true)
      else if (error instanceof DOMException) this.toast('The browser cannot read that file any more; choose it again.', true)
      else {
        console.error(error)
        this.toast('Something in this page went wrong. What you made is saved; loading the page anew helps.', true)
      }
      return undefined
    } finally {
      if (this.busy === busy) this.set({ busy: null })
    }
  }

  // Asks over the page; the answer of the choice, or null.
  ask(question: Omit<Question, 'answer'>): Promise<string | null> {
    this.question?.answer(null)
    return new Promise((resolve) => {
      this.set({ question: { ...question, answer: (answer) => (this.set({ question: null }), resolve(answer)) } })
    })
  }

  // Keeps what was said of a file in sight, in place of what was said of it before.
  tell(from: string, notes: string[]) {
    const rest = this.told.filter((one) => one.from !== from)
    this.set({ told: notes.length > 0 ? [...rest, { from, notes }] : rest })
  }

  // A document that the program did not take: where its models are gone, it goes back to what is open.
  private notSaved(document: Document, problem: string) {
    const open = this.state?.document.models
    if (!open || document !== this.store.document || JSON.stringify(document.models) === JSON.stringify(open)) return
    this.toast(problem, true)
    this.store.takeBack()
  }

  start() {
    this.store.subscribe((edited) => {
      if (edited && !this.readOnly) this.saver.queue(this.store.document)
      this.changed()
    })
    listen(
      {
        job: (job: Job) => this.heard(job),
        tabs: ({ editor }: { editor: string }) => this.set({ editor }),
        state: () => void this.attempt(() => this.refresh(true)),
        live: () => this.live(),
        resync: () => void this.attempt(() => this.catchUp()),
      },
      (lost) => this.set({ lost }),
    )
    addEventListener('focus', () => void this.lookOutside())
    setInterval(() => void this.lookOutside(), 5000)
    return this.attempt(() => this.refresh(true), 'Opening the project')
  }

  private heard(job: Job) {
    if (job.state === 'running' && !this.running) this.jobBegan = performance.now()
    this.set({ job })
    if (job.state === 'failed') this.toast(job.error ?? 'The job failed.', true)
    if (job.state === 'cancelled') this.toast('Cancelled. What was there before is still there.')
    this.jobDone(job)
  }

  // After messages were missed: what they told, from the program's state.
  private async catchUp() {
    const ran = this.running
    await this.refresh(false)
    if (ran && !this.running) this.heard(this.job)
  }

  private async lookOutside() {
    if (document.hidden || this.lost || !this.state) return
    const outside = await api.changes().catch(() => this.outside)
    if (outside.source !== this.outside.source || outside.target !== this.outside.target) this.set({ outside })
  }

  // Fetches the state and whatever of the meshes is not here yet. The document is the page's own, and comes from the
  // program only where another project is open, or another tab edits.
  async refresh(document: boolean) {
    const state = await api.state()
    const first = this.state === null
    const another = this.state?.project.number !== state.project.number
    this.state = state
    this.job = state.job
    if (another || (document && this.readOnly)) {
      const told = documentOf(state.document)
      if (another || JSON.stringify(told) !== JSON.stringify(this.store.document)) this.store.replace(told)
    }
    if (another) await this.begin(first)
    if (document || another) this.fitPlaces = state.fit_is_of_these_markers ? placesOf(this.store.document) : null
    await Promise.all(sides.map((side) => this.loadMesh(side)))
    await this.loadFit()
    if (another && state.meshes.source && state.meshes.target) this.step = 'markers'
    if (another && state.fit) this.shown.add('result')
    this.changed()
    this.stage.draw()
  }

  // Another project is open: what belonged to the one before goes, and undo reaches back to where this one was left.
  private async begin(first: boolean) {
    if (!first) {
      Object.assign(this, { selected: null, told: [], question: null, step: 'open' })
      this.projectChanged()
    }
    this.tell('The project', this.state!.notes)
    try {
      this.store.recall(await api.history())
    } catch {
      // nothing that can be read
    }
  }

  private async loadMesh(side: Side) {
    const info = this.state!.meshes[side]
    if ((info?.hash ?? '') === this.loaded[side]) return
    this.models[side]?.dispose()
    this.models[side] = null
    if (info) {
      const model = await this.fetchModel('api/mesh', { side })
      if (info.colors) model.colors = new Uint8Array(await bytes('api/mesh', { side, what: 'colors' }))
      if (info.uvs) model.setUnwrapped(new Float32Array(await bytes('api/mesh', { side, what: 'uvs' })))
      this.models[side] = model
      void model.prepareTree().then(() => this.changed())
    }
    this.loaded[side] = info?.hash ?? ''
    this.outside[side] = false
    this.pane(side).setModel(this.models[side])
    this.modelsChanged()
  }

  async fetchModel(path: string, values: Record<string, string | number>): Promise<Model> {
    const [positions, normals, triangles] = await Promise.all(
      ['positions', 'normals', 'triangles'].map((what) => bytes(path, { ...values, what })),
    )
    return new Model(
      { positions: new Float32Array(positions), normals: new Int16Array(normals), triangles: new Uint32Array(triangles) },
      this.skin,
      this.pattern,
    )
  }

  async loadFit(force = false) {
    const fit = this.state?.fit
    const key = fit ? JSON.stringify(fit.quality) + this.loaded.source + this.loaded.target : ''
    if (key === this.fitted && !force) return
    this.result?.dispose()
    this.result = null
    if (fit) {
      this.result = await this.fetchModel('api/fitted', {})
      void this.result.prepareTree()
    }
    this.fitted = key
    this.pane('result').setModel(this.result)
    this.modelsChanged()
  }

  info(side: Side): MeshInfo | null {
    return this.state?.meshes[side] ?? null
  }

  // Between a mesh's own coordinates and those that it is drawn in.
  toDrawn(point: Vec3, frame: Frame | undefined): Vector3 {
    if (!frame) return new Vector3()
    return new Vector3(...point.map((value, i) => (value - frame.centre[i]) / frame.scale))
  }
  fromDrawn(point: Vector3, frame: Frame): Vec3 {
    const out = point.toArray().map((value, i) => value * frame.scale + frame.centre[i])
    return out as Vec3
  }
}

export const app = new App()
