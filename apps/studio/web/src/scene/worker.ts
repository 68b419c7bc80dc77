// Builds the picking tree away from the page, which stays fluid meanwhile.
import { BufferAttribute, BufferGeometry } from 'three'
import { MeshBVH } from 'three-mesh-bvh'

onmessage = (event: MessageEvent<{ id: number; positions: Float32Array; index: Uint32Array }>) => {
  const { id, positions, index } = event.data
  const geometry = new BufferGeometry()
  geometry.setAttribute('position', new BufferAttribute(positions, 3))
  geometry.setIndex(new BufferAttribute(index, 1))
  const tree = new MeshBVH(geometry, { indirect: true })
  const data = MeshBVH.serialize(tree, { cloneBuffers: false })
  postMessage({ id, data })
}
