// One view: a scene, its camera, its markers, and the pointer and keys on it.
import { PerspectiveCamera, Raycaster, Scene, Vector2, Vector3 } from 'three'
import { apply, copyPose, orbit, pan, startPose, zoom, type Pose } from './camera'
import { Glass } from './glass'
import type { Model } from './model'
import { Pins } from './pins'

export interface Hit {
  point: Vector3 // as drawn
  corner: Vector3 // the nearest vertex of the triangle
}

export interface PaneEvents {
  click?: (hit: Hit | null, pin: string | null) => void
  dragStart?: (pin: string | null, hit: Hit | null) => boolean // is this drag more than a turn of the view?
  drag?: (hit: Hit) => void
  dragEnd?: () => void
  hover?: (pin: string | null) => void
  turned: () => void // the pose has changed
  draw: () => void // something must be drawn anew
}

const still = 4 // pixels that a click may tremble

export class Pane {
  readonly scene = new Scene()
  readonly camera = new PerspectiveCamera()
  readonly pins = new Pins()
  readonly glass = new Glass()
  pose: Pose = startPose()
  model: Model | null = null
  element: HTMLElement | null = null
  private raycaster = new Raycaster()
  private flight = 0
  private abort: AbortController | null = null

  constructor(private events: PaneEvents) {
    this.scene.add(this.pins.mesh, this.glass.group)
  }

  setModel(model: Model | null) {
    if (this.model === model) return
    this.model?.group.removeFromParent()
    this.model = model
    if (model) this.scene.add(model.group)
    this.events.draw()
  }

  // The element whose place on the page the view fills.
  attach(element: HTMLElement | null) {
    this.abort?.abort()
    this.element = element
    if (!element) return
    this.abort = new AbortController()
    const options = { signal: this.abort.signal }
    element.addEventListener('pointerdown', this.down, options)
    element.addEventListener('pointermove', this.move, options)
    element.addEventListener('wheel', this.wheel, { ...options, passive: false })
    element.addEventListener('keydown', this.key, options)
    element.addEventListener('contextmenu', (event) => event.preventDefault(), options)
    this.events.draw()
  }

  prepare(width: number, height: number) {
    apply(this.pose, this.camera, width / height)
    this.pins.setViewport(width, height)
  }

  // Draws the model alone, from where views begin, so that it fills the picture.
  portrait(aspect: number, draw: () => void) {
    const shown = [this.pins.mesh.visible, this.glass.group.visible]
    this.pins.mesh.visible = this.glass.group.visible = false
    this.model!.geometry.computeBoundingBox()
    const size = this.model!.geometry.boundingBox!.getSize(new Vector3())
    const half = Math.tan((this.camera.fov * Math.PI) / 360)
    const distance = Math.max(size.y, Math.max(size.x, size.z) / aspect) / (2 * half) + Math.max(size.x, size.z) / 3
    apply({ ...startPose(), distance: 1.04 * distance }, this.camera, aspect)
    draw()
    ;[this.pins.mesh.visible, this.glass.group.visible] = shown
  }

  // What lies under a place of the view, in pixels from its upper left corner; by default under its middle.
  hit(x?: number, y?: number): Hit | null {
    const tree = this.model?.pickingTree
    if (!tree || !this.element) return null
    const { clientWidth, clientHeight } = this.element
    const at = new Vector2(((x ?? clientWidth / 2) / clientWidth) * 2 - 1, 1 - ((y ?? clientHeight / 2) / clientHeight) * 2)
    apply(this.pose, this.camera, clientWidth / clientHeight)
    this.raycaster.setFromCamera(at, this.camera)
    const found = tree.raycastFirst(this.raycaster.ray, 2)
    if (!found || !found.face) return null
    const positions = this.model!.geometry.getAttribute('position')
    let corner = new Vector3()
    let least = Infinity
    for (const vertex of [found.face.a, found.face.b, found.face.c]) {
      const place = new Vector3().fromBufferAttribute(positions, vertex)
      if (place.distanceTo(found.point) < least) (least = place.distanceTo(found.point)), (corner = place)
    }
    return { point: found.point.clone(), corner }
  }

  // The marker under a place, the nearest to the camera; those behind the surface do not count.
  pinAt(x: number, y: number): string | null {
    if (!this.element) return null
    const { clientWidth, clientHeight } = this.element
    apply(this.pose, this.camera, clientWidth / clientHeight)
    const surface = this.hit(x, y)
    const limit = surface ? surface.point.distanceTo(this.camera.position) + 0.02 : Infinity
    let best: string | null = null
    let least = Infinity
    for (const pin of this.pins.pins) {
      if (pin.ghost) continue
      const place = pin.at.clone().project(this.camera)
      const dx = ((place.x + 1) / 2) * clientWidth - x
      const dy = ((1 - place.y) / 2) * clientHeight - y
      const away = pin.at.distanceTo(this.camera.position)
      if (Math.hypot(dx, dy) <= pin.size + 2 && away < limit && away < least) (least = away), (best = pin.id)
    }
    return best
  }

  // Moves the camera there in a moment, keeping its side, or to the side given.
  flyTo(focus: Vector3, distance: number, facing?: Vector3) {
    const from = copyPose(this.pose)
    const to = copyPose(this.pose)
    to.focus.copy(focus)
    to.distance = distance
    if (facing && facing.lengthSq() > 0) {
      to.yaw = Math.atan2(facing.x, facing.z)
      to.pitch = Math.max(-1.2, Math.min(1.2, Math.asin(facing.y / facing.length())))
    }
    to.yaw = from.yaw + Math.atan2(Math.sin(to.yaw - from.yaw), Math.cos(to.yaw - from.yaw))
    const run = ++this.flight
    const start = performance.now()
    const calm = matchMedia('(prefers-reduced-motion: reduce)').matches
    const step = () => {
      if (run !== this.flight) return
      const t = calm ? 1 : Math.min(1, (performance.now() - start) / 350)
      const s = t * t * (3 - 2 * t)
      this.pose.yaw = from.yaw + (to.yaw - from.yaw) * s
      this.pose.pitch = from.pitch + (to.pitch - from.pitch) * s
      this.pose.distance = from.distance * Math.pow(to.distance / from.distance, s)
      this.pose.focus.lerpVectors(from.focus, to.focus, s)
      this.turned()
      if (t < 1) requestAnimationFrame(step)
    }
    step()
  }

  private turned() {
    this.events.turned()
    this.events.draw()
  }

  private place(event: MouseEvent): [number, number] {
    const box = this.element!.getBoundingClientRect()
    return [event.clientX - box.left - this.element!.clientLeft, event.clientY - box.top - this.element!.clientTop]
  }

  private down = (event: PointerEvent) => {
    if (event.target instanceof Element && event.target.closest('button, select, input, a')) return
    ++this.flight
    const element = this.element!
    element.focus({ preventScroll: true })
    const start = this.place(event)
    let last: [number, number] = start
    let moved = false
    const pin = event.button === 0 ? this.pinAt(...start) : null
    const dragging = event.button === 0 && !event.shiftKey && (this.events.dragStart?.(pin, this.hit(...start)) ?? false)
    element.setPointerCapture(event.pointerId)
    event.preventDefault()

    const onMove = (e: PointerEvent) => {
      const now = this.place(e)
      moved ||= Math.hypot(now[0] - start[0], now[1] - start[1]) > still
      if (!moved) return
      const [dx, dy] = [now[0] - last[0], now[1] - last[1]]
      last = now
      if (dragging) {
        const hit = this.hit(...now)
        if (hit) this.events.drag?.(hit)
        return
      }
      if (event.button === 2 || e.shiftKey) pan(this.pose, dx, dy, element.clientHeight)
      else if (event.button === 1 && e.ctrlKey) zoom(this.pose, dy * 0.01)
      else orbit(this.pose, dx, dy)
      this.turned()
    }
    const onUp = (e: PointerEvent) => {
      element.removeEventListener('pointermove', onMove)
      element.removeEventListener('pointerup', onUp)
      element.removeEventListener('pointercancel', onUp)
      if (dragging) this.events.dragEnd?.()
      if (!moved && event.button === 0 && e.type === 'pointerup') this.events.click?.(this.hit(...start), pin)
    }
    element.addEventListener('pointermove', onMove)
    element.addEventListener('pointerup', onUp)
    element.addEventListener('pointercancel', onUp)
  }

  private move = (event: PointerEvent) => {
    if (event.buttons === 0) this.events.hover?.(this.pinAt(...this.place(event)))
  }

  private wheel = (event: WheelEvent) => {
    event.preventDefault()
    const lines = event.deltaMode === 1 ? event.deltaY * 30 : event.deltaY
    zoom(this.pose, Math.max(-0.4, Math.min(0.4, lines * 0.0015)))
    this.turned()
  }

  private key = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== this.element) return
    const step = 12
    const by: Record<string, [number, number]> = {
      ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step],
    }
    if (event.key in by) {
      const [dx, dy] = by[event.key]
      if (event.shiftKey) pan(this.pose, dx * 2, dy * 2, this.element!.clientHeight)
      else orbit(this.pose, dx, dy)
    } else if (event.key === '+' || event.key === '=') zoom(this.pose, -0.15)
    else if (event.key === '-') zoom(this.pose, 0.15)
    else return
    event.preventDefault()
    this.turned()
  }
}
