// What the tests of the studio share: the real program in a state folder of its own, and a headless browser.
import { spawn, spawnSync } from 'node:child_process'
import { existsSync, mkdtempSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'
import { chromium } from 'playwright-core'

export const program = process.env.MESHTWEEN_PROGRAM
if (!program) throw new Error('MESHTWEEN_PROGRAM must name the program')

export function scratch(t) {
  const folder = mkdtempSync(join(tmpdir(), 'meshtween-studio-test-'))
  t.after(() => rmSync(folder, { recursive: true, force: true }))
  return folder
}

// The program's answer to a command line.
export function run(...args) {
  const done = spawnSync(program, args, { encoding: 'utf8' })
  return { status: done.status, out: done.stdout, err: done.stderr }
}

export async function start(t, state, args = []) {
  const child = spawn(program, ['studio', '--no-browser', ...args], {
    env: { ...process.env, XDG_STATE_HOME: state, DISPLAY: '' },
    stdio: ['ignore', 'pipe', 'pipe'],
  })
  t.after(() => child.kill('SIGKILL'))
  let told = ''
  child.stderr.on('data', (data) => (told += data))
  const address = await new Promise((resolve, reject) => {
    let out = ''
    child.stdout.on('data', (data) => {
      out += data
      if (out.includes('\n')) resolve(out.slice(0, out.indexOf('\n')))
    })
    child.on('exit', (status) => reject(new Error(`the studio ended with ${status}: ${told}`)))
  })
  const ended = new Promise((resolve) => child.on('exit', (status, signal) => resolve({ status, signal })))
  return { child, address, ended, url: new URL(address) }
}

export async function browser(t) {
  const one = await chromium.launch({
    executablePath: process.env.MESHTWEEN_CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--headless', '--no-sandbox', '--disable-gpu', '--disable-background-networking', '--disable-component-update',
      '--disable-sync', '--disable-quic', '--no-first-run', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    ],
  })
  t.after(() => one.close())
  return one
}

// A page of the studio, ready; fails the test where the page itself does.
export async function open(one, address, size = { width: 1280, height: 720 }, colorScheme = 'light') {
  const context = await one.newContext({ viewport: size, colorScheme, reducedMotion: 'reduce' })
  const page = await context.newPage()
  page.setDefaultTimeout(60000)
  page.problems = []
  page.on('pageerror', (error) => page.problems.push(String(error)))
  page.on('console', (line) => line.type() === 'error' && page.problems.push(line.text()))
  await page.goto(address)
  await page.getByRole('button', { name: 'Models' }).waitFor()
  return page
}

const shared = process.env.MESHTWEEN_SHARED ?? join(dirname(fileURLToPath(import.meta.url)), '../../../shared')

// Igea and Max Planck where the shared data is, else the program's own sample.
export function models(folder) {
  const there = join(shared, 'data/head_igea_to_max_planck')
  if (existsSync(there))
    return { source: join(there, 'source.obj'), target: join(there, 'target.obj'), markers: join(there, 'markers.csv') }
  const made = run('sample', 'bow', '-o', folder)
  if (made.status !== 0) throw new Error(made.err)
  return {
    source: join(folder, 'bow_source.ply'), target: join(folder, 'bow_target.ply'), markers: join(folder, 'bow_markers.csv'),
  }
}

export async function saved(page) {
  await page.waitForFunction(() => window.studio.saver.state === 'saved')
  await page.locator('.saved.saved:text-is("Saved")').waitFor()
}

// Both picking trees are there.
export async function ready(page) {
  await page.waitForFunction(() => ['source', 'target'].every((side) => window.studio.models[side]?.pickingTree))
}

// A ball of triangles as OBJ.
export function ball(radius, shift = 0, rings = 10) {
  const lines = []
  const parts = 2 * rings
  const at = (r, p) => (r - 1) * parts + (p % parts) + 1
  for (let r = 1; r < rings; ++r)
    for (let p = 0; p < parts; ++p) {
      const [a, b] = [(Math.PI * r) / rings, (2 * Math.PI * p) / parts]
      lines.push(`v ${radius * Math.sin(a) * Math.sin(b) + shift} ${radius * Math.cos(a)} ${radius * Math.sin(a) * Math.cos(b)}`)
    }
  const [top, low] = [(rings - 1) * parts + 1, (rings - 1) * parts + 2]
  lines.push(`v ${shift} ${radius} 0`, `v ${shift} ${-radius} 0`)
  for (let p = 0; p < parts; ++p) {
    lines.push(`f ${top} ${at(1, p)} ${at(1, p + 1)}`, `f ${low} ${at(rings - 1, p + 1)} ${at(rings - 1, p)}`)
    for (let r = 1; r < rings - 1; ++r) lines.push(`f ${at(r, p)} ${at(r + 1, p)} ${at(r + 1, p + 1)}`, `f ${at(r, p)} ${at(r + 1, p + 1)} ${at(r, p + 1)}`)
  }
  return lines.join('\n') + '\n'
}

// Drops files on an element, as the browser tells of them.
export const drop = (page, selector, files) =>
  page.evaluate(
    ([selector, files]) => {
      const data = new DataTransfer()
      for (const { name, text, type, size } of files) {
        const file = new File([text ?? ''], name, { type: type ?? '' })
        if (size) Object.defineProperty(file, 'size', { value: size })
        data.items.add(file)
      }
      const event = new DragEvent('drop', { bubbles: true, cancelable: true, dataTransfer: data })
      document.querySelector(selector).dispatchEvent(event)
    },
    [selector, files],
  )

export const toast = (page, text) => page.locator('.toasts p').filter({ hasText: text }).first()
