// The page's state apart from the document: what is open, shown and selected, and how it comes from the program.
import { Vector3 } from 'three'
import { api, bytes, listen, tab } from './api'
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

class App {
  store = new Store()
  saver = new Saver(() => this.changed())
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
  editor = '' // the tab that may edit
  lost = false // no word from the program
  busy = '' // what the page waits for
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

  // Runs what a person asked for; what goes wrong is told.
  async attempt<T>(what: () => Promise<T>, busy = ''): Promise<T | undefined> {
    if (busy) this.set({ busy })
    try {
      return await what()
    } catch (error) {
      this.toast((error as Error).message, true)
      return undefined
    } finally {
      if (busy) this.set({ busy: '' })
    }
  }

  start() {
    this.store.subscribe((edited) => {
      if (edited && !this.readOnly) this.saver.queue(this.store.document)
      this.changed()
    })
    listen(
      {
        job: (job: Job) => this.told(job),
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

  private told(job: Job) {
    this.set({ job })
    if (job.state === 'failed') this.toast(job.error ?? 'The job failed.', true)
    if (job.state === 'cancelled') this.toast('Cancelled. What was there before is still there.')
    this.jobDone(job)
  }

  // After messages were missed: what they told, from the program's state.
  private async catchUp() {
    const ran = this.running
    await this.refresh(false)
    if (ran && !this.running) this.told(this.job)
  }

  private async lookOutside() {
    if (document.hidden || this.lost || !this.state) return
    const outside = await api.changes().catch(() => this.outside)
    if (outside.source !== this.outside.source || outside.target !== this.outside.target) this.set({ outside })
  }

  // Fetches the state and whatever of the meshes is not here yet.
  async refresh(document: boolean) {
    const state = await api.state()
    const first = this.state === null
    this.state = state
    this.job = state.job
    if (document) {
      const empty = emptyDocument()
      const told: Document = {
        markers: state.document.markers,
        symmetry: { ...empty.symmetry, ...state.document.symmetry },
        timing: { ...empty.timing, ...state.document.timing },
        options: { fit: state.document.options.fit ?? {}, morph: state.document.options.morph ?? {} },
      }
      if (JSON.stringify(told) !== JSON.stringify(this.store.document)) this.store.replace(told)
    }
    if (first) this.keepHistory(state.project.file)
    if (document) this.fitPlaces = state.fit_is_of_these_markers ? placesOf(this.store.document) : null
    for (const note of state.notes) this.toast(note, true)
    await Promise.all(sides.map((side) => this.loadMesh(side)))
    await this.loadFit()
    if (first && state.meshes.source && state.meshes.target) this.step = 'markers'
    if (first && state.fit) this.shown.add('result')
    this.changed()
    this.stage.draw()
  }

  // Undo reaches back over a reload of the page.
  private keepHistory(project: string) {
    const name = `history of ${project}`
    try {
      this.store.recall(sessionStorage.getItem(name) ?? '{}')
    } catch {
      // nothing that can be read
    }
    addEventListener('pagehide', () => {
      try {
        sessionStorage.setItem(name, this.store.history())
      } catch {
        // too long to keep
      }
    })
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
