// Fit, morph and export: what is asked of the program and what is shown of its answers.
import { api, bytes, download } from './api'
import { app, type Heat } from './app'
import { placesOf } from './edits'
import * as painting from './painting'
import { pictureSoon } from './pictures'
import { heatColors, most } from './scene/heat'
import type { Model } from './scene/model'
import type { Job, PathInfo, Vec3 } from './types'

export interface Player {
  u: number
  playing: boolean
  speed: number // ends in a second
  mode: 'once' | 'loop' | 'ping-pong'
  ease: boolean
  direction: number
}

export const player: Player = { u: 0, playing: false, speed: 0.5, mode: 'ping-pong', ease: true, direction: 1 }

// The paths that are shown: in the result's view and, side by side, in the comparison's.
export const paths: { main: PathInfo | null; compare: PathInfo | null; compareMethod: string } = {
  main: null, compare: null, compareMethod: '',
}
let compareModel: Model | null = null
let wantedFor: 'main' | 'compare' | null = null
export const exports: { files: string[]; folder: string } = { files: [], folder: '' }
const tickers = new Set<(u: number) => void>()

export function onTick(listener: (u: number) => void) {
  tickers.add(listener)
  return () => tickers.delete(listener)
}

const smooth = (u: number) => (player.ease ? u * u * (3 - 2 * u) : u)
let clock = 0

export function seek(u: number) {
  player.u = Math.min(1, Math.max(0, u))
  app.result?.setParameter(smooth(player.u))
  compareModel?.setParameter(smooth(player.u))
  for (const tick of tickers) tick(player.u)
  app.stage.draw()
}

export function play(on: boolean) {
  if (on && !paths.main) return
  if (on && player.mode === 'once' && player.u >= 1) player.u = 0
  player.playing = on
  clock = 0
  app.changed()
  app.stage.draw()
}

function animate(now: number): boolean {
  if (!player.playing) return false
  const passed = clock ? Math.min(0.1, (now - clock) / 1000) : 0
  clock = now
  let u = player.u + player.direction * passed * player.speed
  if (player.mode === 'ping-pong') {
    if (u > 1) (u = 2 - u), (player.direction = -1)
    if (u < 0) (u = -u), (player.direction = 1)
  } else {
    player.direction = 1
    if (u > 1 && player.mode === 'loop') u %= 1
    else if (u >= 1) (player.playing = false), app.changed()
  }
  seek(u)
  return player.playing
}

let fittingPlaces = ''

export async function startFit() {
  await app.attempt(async () => {
    await app.saver.flush()
    play(false)
    app.shown.add('result')
    fittingPlaces = placesOf(app.store.document)
    await api.fit(app.store.document.options.fit)
  })
}

const pathRequest = (method?: string) => {
  const { options, timing } = app.store.document
  return { options: { ...options.morph, ...(method ? { method } : {}) }, ...(timing.dabs.length > 0 ? { timing } : {}) }
}

export async function startMorph(compare = false) {
  await app.attempt(async () => {
    await app.saver.flush()
    wantedFor = compare ? 'compare' : 'main'
    const request = pathRequest(compare ? paths.compareMethod : undefined)
    const known = app.state?.paths.find((path) => path.asked === JSON.stringify(request))
    if (known) return showPath(known, wantedFor)
    await api.morph(request)
  })
}

async function fetchNodes(path: PathInfo) {
  const fetchAll = (what: string) =>
    Promise.all(Array.from({ length: path.meshes }, (_, node) => bytes('api/path', { key: path.key, node, what })))
  const [positions, normals] = await Promise.all([fetchAll('positions'), fetchAll('normals')])
  return {
    degree: path.degree,
    knots: path.knots,
    positions: positions.map((buffer) => new Float32Array(buffer)),
    normals: normals.map((buffer) => new Int16Array(buffer)),
  }
}

async function showPath(path: PathInfo, where: 'main' | 'compare') {
  const nodes = await fetchNodes(path)
  const model = await app.fetchModel('api/fitted', {})
  model.setNodes(nodes)
  if (where === 'main') {
    app.result?.dispose()
    app.result = model
    app.pane('result').setModel(model)
    paths.main = path
  } else {
    compareModel?.dispose()
    compareModel = model
    app.pane('compare').setModel(model)
    app.shown.add('compare')
    paths.compare = path
  }
  refreshLook()
  seek(player.u)
  app.changed()
}

export function stopComparing() {
  app.shown.delete('compare')
  paths.compare = null
  app.pane('compare').setModel(null)
  compareModel?.dispose()
  compareModel = null
  app.changed()
}

// Back from the morph to the fitted mesh.
export async function showFitted() {
  if (!paths.main) return
  dropPaths()
  await app.loadFit(true)
}

function dropPaths() {
  paths.main = null
  play(false)
  stopComparing()
}

// The mesh as it stands in the running fit.
let liveBusy = false
async function showLive() {
  if (liveBusy) return
  liveBusy = true
  try {
    const positions = new Float32Array(await bytes('api/live'))
    if (positions.length === 0) return
    if (!app.result || app.result.vertexCount * 3 !== positions.length || paths.main) {
      const model = await app.fetchModel('api/mesh', { side: 'source' })
      app.result?.dispose()
      app.result = model
      paths.main = null
      app.pane('result').setModel(model)
    }
    app.result.setColors(null)
    app.result.setPositions(positions)
    app.result.setShading('flat')
    app.stage.draw()
  } catch {
    // the fit ended meanwhile
  } finally {
    liveBusy = false
  }
}

async function done(job: Job) {
  if (job.kind === 'fit' && job.state !== 'running') {
    dropPaths()
    await app.refresh(false)
    if (job.state === 'done') app.fitPlaces = fittingPlaces
    await app.loadFit(job.state !== 'done')
    refreshLook()
  }
  if (job.kind === 'morph' && job.state === 'done') {
    const path = job.result as PathInfo
    if (app.state && !app.state.paths.some((known) => known.key === path.key)) app.state.paths.push(path)
    await showPath(path, wantedFor ?? 'main')
  }
  if (job.kind === 'export' && job.state === 'done') {
    Object.assign(exports, job.result)
    if (exports.files.length <= 3) for (const name of exports.files) fetchExport(name)
    app.changed()
  }
}

export const fetchExport = (name: string) => download(`api/download?name=${encodeURIComponent(name)}`, name)

export async function startExport(names: string[], frames: number) {
  await app.attempt(async () => {
    await app.saver.flush()
    await api.export({ names, frames, ...pathRequest() })
  })
}

export function chooseHeat(heat: Heat) {
  app.set({ heat })
  void app.attempt(paintHeat)
}

async function paintHeat() {
  const model = app.result
  if (!model) return
  if (paths.main || app.heat === 'none' || !app.state?.fit || app.running) {
    model.setColors(null)
  } else {
    const heat = app.heat
    const values = new Float32Array(await bytes('api/fitted', { what: heat }))
    if (model !== app.result || heat !== app.heat || values.length !== model.vertexCount) return
    if (heat === 'trust') {
      model.setColors(heatColors(values.map((trust) => 1 - trust), 0, 1))
    } else {
      const from = heat === 'stretch' ? 1 : 0
      // Less than a ten-thousandth of the size is nothing to look at.
      app.heatMost = Math.max(most(values), from + 0.01)
      model.setColors(heatColors(values, from, app.heatMost))
    }
  }
  app.changed()
  app.stage.draw()
}

// Brings wires, shading and colours of all models to what is chosen.
export function refreshLook() {
  const dark = getComputedStyle(document.documentElement).getPropertyValue('--wire').trim() || '#223'
  for (const model of [app.models.source, app.models.target, app.result, compareModel]) {
    if (!model) continue
    model.setWires(app.wires, dark)
    model.setShading(app.shading)
    if (model !== app.result) model.setColors(app.shading === 'colour' ? model.colors : null)
  }
  painting.show()
  void app.attempt(paintHeat)
  app.stage.draw()
}

export function flyInResult(at: Vec3) {
  app.shown.add('result')
  app.changed()
  app.pane('result').flyTo(app.toDrawn(at, app.state?.result_frame), 0.35)
}

export function wire() {
  app.store.subscribe(() => painting.show())
  app.stage.animate = animate
  app.jobDone = (job) => void app.attempt(() => done(job))
  app.live = () => void showLive()
  app.modelsChanged = () => {
    refreshLook()
    pictureSoon()
  }
  app.projectChanged = () => {
    dropPaths()
    Object.assign(exports, { files: [], folder: '' })
  }
}
