// The picture of a project in the list of recent ones: its models as they lie, taken when they have changed.
import { api } from './api'
import { app } from './app'
import { sides } from './types'

const [width, height] = [320, 150]
let taken = ''
let waits = 0

export function keepPicture() {
  clearTimeout(waits)
  waits = window.setTimeout(() => void take(), 400)
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
