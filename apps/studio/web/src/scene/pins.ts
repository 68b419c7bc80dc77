// Markers as they are drawn: numbered discs of constant size that face the camera, all of a view in one draw call.
import {
  CanvasTexture, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, PlaneGeometry, ShaderMaterial, Vector2,
  type Vector3,
} from 'three'

export interface Pin {
  id: string
  number: number
  at: Vector3
  color: [number, number, number]
  size: number // radius in pixels
  ghost: boolean // a suggestion, drawn as a ring
}

const cell = 64
const columns = 32

// The numbers 1 to 1023 in one picture; larger ones are drawn without.
function numbers(): CanvasTexture {
  const canvas = document.createElement('canvas')
  canvas.width = canvas.height = cell * columns
  const context = canvas.getContext('2d')!
  context.fillStyle = '#fff'
  context.textAlign = 'center'
  context.textBaseline = 'middle'
  for (let n = 1; n < columns * columns; ++n) {
    context.font = `600 ${n < 10 ? 34 : n < 100 ? 29 : 20}px system-ui, sans-serif`
    context.fillText(String(n), ((n % columns) + 0.5) * cell, (Math.floor(n / columns) + 0.54) * cell)
  }
  return new CanvasTexture(canvas)
}

const vertex = /* glsl */ `
attribute vec3 at; attribute vec3 tint; attribute vec3 look; // number, radius, ghost
uniform vec2 viewport;
varying vec2 corner; varying vec3 color; varying vec3 kind;
void main() {
  vec4 eye = modelViewMatrix * vec4(at, 1.0);
  gl_Position = projectionMatrix * eye;
  eye.xyz *= 1.0 - 0.012 / max(0.05, length(eye.xyz)); // a little towards the camera: the surface does not cut it
  vec4 nearer = projectionMatrix * eye;
  gl_Position.z = nearer.z / nearer.w * gl_Position.w;
  gl_Position.xy += position.xy * (look.y + 1.5) * 2.0 / viewport * gl_Position.w * 2.0;
  corner = position.xy * 2.0 * (look.y + 1.5) / look.y;
  color = tint; kind = look;
}`

const fragment = /* glsl */ `
uniform sampler2D digits;
varying vec2 corner; varying vec3 color; varying vec3 kind;
void main() {
  float r = length(corner), edge = 1.2 / kind.y;
  float disc = 1.0 - smoothstep(1.0 - edge, 1.0, r);
  float ring = smoothstep(0.82 - edge, 0.82, r);
  if (kind.z > 0.5) {
    float inside = 1.0 - smoothstep(0.0, 0.25, r);
    gl_FragColor = vec4(color, disc * max(ring, 0.25 + inside));
    return;
  }
  float ink = 0.0;
  if (kind.x > 0.5 && kind.x < 1023.5 && abs(corner.x) < 0.95 && abs(corner.y) < 0.95) {
    vec2 at = vec2(mod(kind.x, 32.0), floor(kind.x / 32.0)) + vec2(corner.x, -corner.y) * 0.42 + 0.5;
    ink = texture2D(digits, vec2(at.x / 32.0, 1.0 - at.y / 32.0)).a;
  }
  vec3 shade = mix(mix(color, vec3(1.0), ink), vec3(1.0), ring * 0.9);
  gl_FragColor = vec4(shade, disc);
}`

let digits: CanvasTexture | null = null
const quad = new PlaneGeometry(1, 1)

export class Pins {
  pins: Pin[] = []
  readonly mesh: Mesh
  private material: ShaderMaterial

  constructor() {
    digits ??= numbers()
    this.material = new ShaderMaterial({
      vertexShader: vertex, fragmentShader: fragment, transparent: true, depthWrite: false,
      uniforms: { viewport: { value: new Vector2(1, 1) }, digits: { value: digits } },
    })
    this.mesh = new Mesh(quad, this.material)
    this.mesh.frustumCulled = false
    this.mesh.renderOrder = 2
    this.show([])
  }

  setViewport(width: number, height: number) {
    this.material.uniforms.viewport.value.set(width, height)
  }

  show(pins: Pin[]) {
    this.pins = pins
    const count = Math.max(1, pins.length)
    const at = new Float32Array(3 * count)
    const tint = new Float32Array(3 * count)
    const look = new Float32Array(3 * count)
    pins.forEach((pin, i) => {
      at.set([pin.at.x, pin.at.y, pin.at.z], 3 * i)
      tint.set(pin.color, 3 * i)
      look.set([pin.number, pin.size, pin.ghost ? 1 : 0], 3 * i)
    })
    // A new geometry each time: three.js remembers how many instances the first one had.
    if (this.mesh.geometry !== quad) this.mesh.geometry.dispose()
    const geometry = new InstancedBufferGeometry()
    geometry.setAttribute('position', quad.getAttribute('position'))
    geometry.setIndex(quad.index)
    geometry.setAttribute('at', new InstancedBufferAttribute(at, 3))
    geometry.setAttribute('tint', new InstancedBufferAttribute(tint, 3))
    geometry.setAttribute('look', new InstancedBufferAttribute(look, 3))
    geometry.instanceCount = pins.length
    this.mesh.geometry = geometry
    this.mesh.visible = pins.length > 0
  }
}
