// The plane of symmetry, drawn as a pane of glass through the model.
import { DoubleSide, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, PlaneGeometry } from 'three'

const square = new PlaneGeometry(0.9, 0.9) // models are drawn in boxes of unit diagonal
const rim = new EdgesGeometry(square)
const tint = 0x8a5cd6

export class Glass {
  readonly group = new Group()

  constructor() {
    const pane = new Mesh(square, new MeshBasicMaterial({ color: tint, transparent: true, opacity: 0.12, side: DoubleSide, depthWrite: false }))
    this.group.add(pane, new LineSegments(rim, new LineBasicMaterial({ color: tint, transparent: true, opacity: 0.6 })))
    this.group.visible = false
  }

  // Across the axis 0, 1 or 2, that far from the middle; hidden without an axis.
  show(axis: number | null, offset = 0) {
    this.group.visible = axis !== null
    if (axis === null) return
    this.group.rotation.set(axis === 1 ? Math.PI / 2 : 0, axis === 0 ? Math.PI / 2 : 0, 0)
    this.group.position.set(0, 0, 0).setComponent(axis, offset)
  }
}
