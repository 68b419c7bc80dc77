// The picture of a project in the list of recent ones: its models as they lie, taken when they have changed and at the
// latest when the project is left.
import { api } from './api'
import { app } from './app'
import { sides } from './types'

const [width, height] = [320, 150]
let taken = ''
let waits = 0
let running = Promise.resolve()

export function pictureSoon() {
  clearTimeout(waits)
  waits = window.setTimeout(() => void pictureNow(), 400)
}

// Resolves when the picture is kept, or none can be taken.
export function pictureNow(): Promise<void> {
  clearTimeout(waits)
  running = running.then(take)
  return running
}

async function take() {
  const { state } = app
  if (!state || app.readOnly || app.lost || !(app.models.source || app.models.target)) return
  const of = [state.project.number, ...sides.map((side) => app.models[side] && app.info(side)?.hash)].join()
  if (of === taken) return
  const png = await app.stage.picture(sides, width, height)
  if (!png || app.state?.project.number !== state.project.number) return
  taken = of
  await api.savePicture(png).catch(() => (taken = ''))
}
