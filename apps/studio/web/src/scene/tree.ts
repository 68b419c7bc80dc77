// Picking trees: asked of a worker, used here.
import type { BufferGeometry } from 'three'
import { MeshBVH } from 'three-mesh-bvh'

let worker: Worker | null = null
let count = 0
const waiting = new Map<number, (data: any) => void>()

export async function treeOf(geometry: BufferGeometry): Promise<MeshBVH> {
  if (!worker) {
    worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' })
    worker.onmessage = (event) => {
      waiting.get(event.data.id)?.(event.data.data)
      waiting.delete(event.data.id)
    }
  }
  const id = ++count
  const data = await new Promise<any>((resolve) => {
    waiting.set(id, resolve)
    const positions = geometry.getAttribute('position').array
    worker!.postMessage({ id, positions, index: geometry.index!.array })
  })
  data.index = null // ours is the same: the tree keeps its own order
  return MeshBVH.deserialize(data, geometry, { setIndex: false })
}
