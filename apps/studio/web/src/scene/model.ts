// One mesh as it is drawn: surface, wires, colours, the morph's weights, the picking tree.
import {
  BufferAttribute, BufferGeometry, Color, Group, Int16BufferAttribute, LineBasicMaterial, LineSegments, Mesh,
  MeshMatcapMaterial, Uint8BufferAttribute, type Texture,
} from 'three'
import type { MeshBVH } from 'three-mesh-bvh'
import { spline } from '../../../../player/src/spline'
import { treeOf } from './tree'

export type Shading = 'smooth' | 'flat' | 'uv' | 'colour'

export interface Buffers {
  positions: Float32Array
  normals: Int16Array // 4 a vertex
  triangles: Uint32Array
}

export interface Nodes {
  degree: number
  knots: number[]
  positions: Float32Array[]
  normals: Int16Array[]
}

// An inner edge runs both ways: the way from its smaller vertex is drawn. Where some run one way only, the mesh has a
// border, and every way is drawn.
const edgesOf = (triangles: Uint32Array): Uint32Array => {
  const edges = new Uint32Array(triangles.length * 2)
  let count = 0
  let balance = 0
  const each = (wanted: (a: number, b: number) => boolean) => {
    count = 0
    for (let t = 0; t < triangles.length; t += 3)
      for (let k = 0; k < 3; ++k) {
        const a = triangles[t + k]
        const b = triangles[t + ((k + 1) % 3)]
        balance += a < b ? 7 * a + b : -7 * b - a
        if (wanted(a, b)) (edges[count++] = a), (edges[count++] = b)
      }
  }
  each((a, b) => a < b)
  if (balance !== 0) each(() => true)
  return edges.slice(0, count)
}

const normalAttribute = (normals: Int16Array) => {
  const attribute = new Int16BufferAttribute(normals, 4, true)
  return attribute as unknown as BufferAttribute
}

export class Model {
  readonly group = new Group()
  readonly geometry = new BufferGeometry()
  colors: Uint8Array | null = null // the file's own
  private material: MeshMatcapMaterial
  private surface: Mesh
  private wires: LineSegments | null = null
  private unwrapped: { geometry: BufferGeometry; mesh: Mesh } | null = null
  private tree: MeshBVH | null = null
  private treeWanted: Promise<MeshBVH> | null = null
  private weights: (u: number) => number[] = () => []

  constructor(buffers: Buffers, private skin: Texture, private pattern: Texture) {
    this.geometry.setAttribute('position', new BufferAttribute(buffers.positions, 3))
    this.geometry.setAttribute('normal', normalAttribute(buffers.normals))
    this.geometry.setIndex(new BufferAttribute(buffers.triangles, 1))
    this.geometry.computeBoundingSphere()
    this.material = new MeshMatcapMaterial({ matcap: skin, side: 2, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 })
    this.surface = new Mesh(this.geometry, this.material)
    this.surface.frustumCulled = false
    this.group.add(this.surface)
  }

  get vertexCount() {
    return this.geometry.getAttribute('position').count
  }

  get influences() {
    return this.surface.morphTargetInfluences ?? []
  }

  async prepareTree(): Promise<MeshBVH> {
    this.treeWanted ??= treeOf(this.geometry)
    this.tree = await this.treeWanted
    return this.tree
  }
  get pickingTree() {
    return this.tree
  }

  setPositions(positions: Float32Array, normals?: Int16Array) {
    const attribute = this.geometry.getAttribute('position') as BufferAttribute
    attribute.copyArray(positions)
    attribute.needsUpdate = true
    if (normals) this.geometry.setAttribute('normal', normalAttribute(normals))
    this.tree = null
    this.treeWanted = null
  }

  setTint(color: string) {
    this.material.color = new Color(color)
  }

  setColors(colors: Uint8Array | null) {
    if (colors) this.geometry.setAttribute('color', new Uint8BufferAttribute(colors, 4, true))
    else this.geometry.deleteAttribute('color')
    if (this.material.vertexColors !== (colors !== null)) {
      this.material.vertexColors = colors !== null
      this.material.needsUpdate = true
    }
  }

  setShading(shading: Shading) {
    const flat = shading === 'flat'
    if (this.material.flatShading !== flat) {
      this.material.flatShading = flat
      this.material.needsUpdate = true
    }
    const uv = shading === 'uv' && this.unwrapped !== null
    this.surface.visible = !uv
    if (this.unwrapped) this.unwrapped.mesh.visible = uv
  }

  // A corner each: seams give one vertex several places in the picture.
  setUnwrapped(uvs: Float32Array) {
    const geometry = this.geometry.toNonIndexed()
    geometry.setAttribute('uv', new BufferAttribute(uvs, 2))
    const mesh = new Mesh(geometry, new MeshMatcapMaterial({ matcap: this.skin, map: this.pattern, side: 2 }))
    mesh.frustumCulled = false
    mesh.visible = false
    this.group.add(mesh)
    this.unwrapped = { geometry, mesh }
  }

  setWires(on: boolean, color: string) {
    if (on && !this.wires) {
      const geometry = new BufferGeometry()
      geometry.attributes.position = this.geometry.attributes.position
      geometry.morphAttributes.position = this.geometry.morphAttributes.position
      geometry.setIndex(new BufferAttribute(edgesOf(this.geometry.index!.array as Uint32Array), 1))
      geometry.boundingSphere = this.geometry.boundingSphere
      this.wires = new LineSegments(geometry, new LineBasicMaterial({ transparent: true, opacity: 0.35 }))
      this.wires.frustumCulled = false
      this.wires.morphTargetInfluences = this.surface.morphTargetInfluences
      this.group.add(this.wires)
    }
    if (this.wires) {
      this.wires.visible = on
      ;(this.wires.material as LineBasicMaterial).color = new Color(color)
    }
  }

  // The path's control meshes become morph targets in the graphics card: playing sends weights alone.
  setNodes(nodes: Nodes) {
    this.weights = spline(nodes.degree, nodes.knots)
    this.geometry.morphAttributes.position = nodes.positions.map((array) => new BufferAttribute(array, 3))
    this.geometry.morphAttributes.normal = nodes.normals.map(normalAttribute)
    this.geometry.morphTargetsRelative = false
    this.surface.updateMorphTargets()
    this.material.needsUpdate = true
    this.setParameter(0)
  }

  setParameter(u: number) {
    const influences = this.surface.morphTargetInfluences
    if (!influences) return
    this.weights(u).forEach((weight, i) => (influences[i] = weight))
  }

  dispose() {
    this.geometry.dispose()
    this.material.dispose()
    this.wires?.geometry.dispose()
    this.unwrapped?.geometry.dispose()
    this.group.removeFromParent()
  }
}
