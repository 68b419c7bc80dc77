// One canvas behind all views: each is drawn into its rectangle, and only when something has changed.
import { SRGBColorSpace, WebGLRenderer } from 'three'
import { copyPose } from './camera'
import { Pane, type PaneEvents } from './pane'

export class Stage {
  readonly panes = new Map<string, Pane>()
  readonly renderer: WebGLRenderer
  linked = false
  // Called before each drawing; says whether something moves on.
  animate: (now: number) => boolean = () => false
  drawn = 0
  private wanted = false
  private host: HTMLElement | null = null
  private observer = new ResizeObserver(() => this.draw())

  constructor() {
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true, powerPreference: 'high-performance' })
    this.renderer.outputColorSpace = SRGBColorSpace
    this.renderer.setClearColor(0, 0)
    this.renderer.setScissorTest(true)
    this.renderer.domElement.className = 'stage'
    this.renderer.domElement.setAttribute('aria-hidden', 'true')
  }

  add(name: string, events: Omit<PaneEvents, 'turned' | 'draw'>): Pane {
    const pane: Pane = new Pane({ ...events, turned: () => this.turned(pane), draw: () => this.draw() })
    this.panes.set(name, pane)
    return pane
  }

  attach(host: HTMLElement | null) {
    this.observer.disconnect()
    this.host = host
    if (!host) return
    host.prepend(this.renderer.domElement)
    this.observer.observe(host)
    this.draw()
  }

  observe(element: HTMLElement) {
    this.observer.observe(element)
  }

  link(on: boolean, from: Pane) {
    this.linked = on
    if (on) this.turned(from)
    this.draw()
  }

  draw() {
    if (this.wanted) return
    this.wanted = true
    requestAnimationFrame((now) => {
      this.wanted = false
      const more = this.animate(now)
      this.render()
      if (more) this.draw()
    })
  }

  // A picture of the models in these panes, side by side and from where views begin, on a clear ground.
  picture(names: string[], width: number, height: number): Promise<Blob | null> {
    const panes = names.map((name) => this.panes.get(name)!).filter((pane) => pane.model)
    const canvas = document.createElement('canvas')
    Object.assign(canvas, { width, height })
    const context = canvas.getContext('2d')
    const ratio = this.renderer.getPixelRatio()
    if (!context || panes.length === 0 || this.renderer.domElement.width < width || this.renderer.domElement.height < height) return Promise.resolve(null)
    const part = width / panes.length
    this.renderer.setScissor(0, 0, this.renderer.domElement.width, this.renderer.domElement.height)
    this.renderer.clear()
    panes.forEach((pane, i) => {
      const box = [(i * part) / ratio, 0, part / ratio, height / ratio] as const
      this.renderer.setViewport(...box)
      this.renderer.setScissor(...box)
      pane.portrait(part / height, () => this.renderer.render(pane.scene, pane.camera))
    })
    context.drawImage(this.renderer.domElement, 0, this.renderer.domElement.height - height, width, height, 0, 0, width, height)
    this.render()
    return new Promise((resolve) => canvas.toBlob(resolve, 'image/png'))
  }

  private turned(pane: Pane) {
    if (!this.linked) return
    for (const other of this.panes.values()) if (other !== pane) other.pose = copyPose(pane.pose)
    this.draw()
  }

  private render() {
    if (!this.host) return
    const box = this.host.getBoundingClientRect()
    const ratio = Math.min(2, devicePixelRatio)
    const canvas = this.renderer.domElement
    if (box.width < 2 || box.height < 2) return
    if (canvas.width !== Math.floor(box.width * ratio) || canvas.height !== Math.floor(box.height * ratio)) {
      this.renderer.setPixelRatio(ratio)
      this.renderer.setSize(box.width, box.height)
    }
    this.renderer.setScissor(0, 0, box.width, box.height)
    this.renderer.clear()
    for (const pane of this.panes.values()) {
      if (!pane.element?.isConnected) continue
      const place = pane.element.getBoundingClientRect()
      const { clientWidth: width, clientHeight: height, clientLeft: left, clientTop: top } = pane.element // without its border
      if (width < 2 || height < 2) continue
      const x = place.left + left - box.left
      const y = box.bottom - (place.top + top + height)
      this.renderer.setViewport(x, y, width, height)
      this.renderer.setScissor(x, y, width, height)
      pane.prepare(width, height)
      this.renderer.render(pane.scene, pane.camera)
    }
    ++this.drawn
  }
}
