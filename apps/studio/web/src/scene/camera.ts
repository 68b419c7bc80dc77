// A turntable camera as in Blender: the model stands upright, the camera walks around a point and looks at it. All
// models are drawn in boxes of unit diagonal, so that one pose fits every view.
import { PerspectiveCamera, Vector3 } from 'three'

export interface Pose {
  yaw: number // radians around the vertical; 0 looks at the front (from +z)
  pitch: number // radians above the horizon
  distance: number
  focus: Vector3
}

export const startPose = (): Pose => ({ yaw: 0.35, pitch: 0.15, distance: 2.1, focus: new Vector3() })
export const copyPose = (pose: Pose): Pose => ({ ...pose, focus: pose.focus.clone() })

const limit = Math.PI / 2 - 0.001

export function orbit(pose: Pose, dx: number, dy: number) {
  pose.yaw -= dx * 0.008
  pose.pitch = Math.min(limit, Math.max(-limit, pose.pitch + dy * 0.008))
}

export function pan(pose: Pose, dx: number, dy: number, height: number) {
  const { right, up } = axes(pose)
  const step = (2 * pose.distance * Math.tan(fov / 2)) / height
  pose.focus.addScaledVector(right, -dx * step).addScaledVector(up, dy * step)
}

export function zoom(pose: Pose, steps: number) {
  pose.distance = Math.min(20, Math.max(0.01, pose.distance * Math.exp(steps)))
}

const fov = (30 * Math.PI) / 180

function axes(pose: Pose) {
  const back = new Vector3(
    Math.sin(pose.yaw) * Math.cos(pose.pitch),
    Math.sin(pose.pitch),
    Math.cos(pose.yaw) * Math.cos(pose.pitch),
  )
  const right = new Vector3(Math.cos(pose.yaw), 0, -Math.sin(pose.yaw))
  return { back, right, up: new Vector3().crossVectors(back, right) }
}

export function apply(pose: Pose, camera: PerspectiveCamera, aspect: number) {
  const { back } = axes(pose)
  camera.fov = (fov * 180) / Math.PI
  camera.aspect = aspect
  // A narrow view steps back, so that the model's width fits.
  const distance = pose.distance * Math.max(1, 0.64 / aspect)
  camera.position.copy(pose.focus).addScaledVector(back, distance)
  camera.up.set(0, 1, 0)
  camera.lookAt(pose.focus)
  camera.near = Math.max(0.002, distance / 100)
  camera.far = distance + 10
  camera.updateProjectionMatrix()
  camera.updateMatrixWorld()
}
