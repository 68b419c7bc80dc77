// How the studio's page bears large models: MESHTWEEN_PROGRAM=build/release/apps/cli/meshtween node tools/studio_frames.mjs [SUBDIVISIONS]
// Opens the sample `build`, subdivided (3: 1.5 million triangles a model), turns a view and tells what a frame costs the
// page's own thread, what it takes on this machine's graphics, and the longest that the page did not answer.
import { mkdtempSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { browser, open, ready, run, start } from '../tests/studio/studio.mjs'

const work = mkdtempSync(join(tmpdir(), 'meshtween-frames-'))
const last = []
const t = { after: (what) => last.push(what) }
const middle = (list) => [...list].sort((a, b) => a - b)[list.length >> 1]

try {
  const made = run('sample', 'build', '--subdivide', process.argv[2] ?? '3', '-o', work)
  if (made.status !== 0) throw new Error(made.err)
  const [source, target] = ['source', 'target'].map((side) => join(work, `build_${side}.ply`))
  const studio = await start(t, join(work, 'state'), [source, target])
  const began = performance.now()
  const page = await open(await browser(t), studio.address)
  await page.evaluate(() => {
    window.blocked = []
    new PerformanceObserver((list) => window.blocked.push(...list.getEntries().map((entry) => entry.duration))).observe({ type: 'longtask', buffered: true })
  })
  page.setDefaultTimeout(300000)
  await ready(page)
  const loaded = performance.now() - began
  const told = await page.evaluate(async () => {
    const { stage, models } = window.studio
    const view = window.studio.pane('source')
    const own = []
    const whole = []
    const frame = () => new Promise(requestAnimationFrame)
    await frame()
    for (let i = 0; i < 12; ++i) {
      const start = performance.now()
      view.pose.yaw += 0.05
      stage.render()
      own.push(performance.now() - start)
      stage.renderer.getContext().finish()
      await frame()
      whole.push(performance.now() - start)
    }
    return { own, whole, blocked: window.blocked, triangles: models.source.geometry.index.count / 3 }
  })
  console.log(`${told.triangles} triangles in each of two views`)
  console.log(`ready to pick after ${(loaded / 1000).toFixed(1)} s; the page was longest busy for ${Math.round(Math.max(0, ...told.blocked))} ms`)
  console.log(`a frame takes ${middle(told.own).toFixed(2)} ms of the page's thread, ${middle(told.whole).toFixed(1)} ms in all on this machine's graphics`)
  if (page.problems.length) throw new Error(page.problems.join('\n'))
} finally {
  for (const what of last.reverse()) await what()
  rmSync(work, { recursive: true, force: true })
}
