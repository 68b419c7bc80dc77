// Markers to files and back, in every format, read by the studio and by a reader that is not ours.
import assert from 'node:assert/strict'
import { spawnSync } from 'node:child_process'
import { readFileSync, writeFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'
import test from 'node:test'
import { ball, browser, drop, open, ready, saved, scratch, start, toast } from './studio.mjs'

const reader = join(dirname(fileURLToPath(import.meta.url)), '../io/landmark_reader.py')
const markers = (page) => page.evaluate(() => window.studio.store.document.markers)
const put = (page, list) => page.evaluate((list) => window.studio.store.edit('put markers', (d) => ({ ...d, markers: list })), list)
const step = (page, name) => page.getByRole('navigation').getByRole('button', { name }).click()
const near = (a, b, what) => a.forEach((value, k) => assert.ok(Math.abs(value - b[k]) < 1e-5, `${what}: ${a} ${b}`))
const marker = (id, name, source, target) => ({ id, name, source, target, locked: false })

// Five on both models, one on each alone. The target is the source, moved by 10 and twice as large.
const [up, across] = [[0, 1, 0], [[1, 0, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]]
const there = ([x, y, z]) => [2 * x + 10, 2 * y, 2 * z]
const names = ['nose tip', 'Ohr é', 'a,b', 'chin', '7']
const all = [
  ...across.map((at, i) => marker(`m${i}`, names[i], at, there(at))),
  marker('m5', 'only here', up, null),
  marker('m6', 'only there', null, there([0, 0.6, 0.8])),
]

async function pair(t) {
  const folder = scratch(t)
  const [a, b] = ['a.obj', 'b.obj'].map((name) => join(folder, name))
  writeFileSync(a, ball(1))
  writeFileSync(b, ball(2, 10))
  const studio = await start(t, join(folder, 'state'), [a, b])
  const page = await open(await browser(t), studio.address)
  await ready(page)
  return { folder, page, meshes: [a, b] }
}

// Does what makes the page hand over files, and returns them by their names.
async function downloads(page, count, make) {
  const found = []
  const take = (one) => found.push(one)
  page.on('download', take)
  await make()
  while (found.length < count) await page.waitForTimeout(50)
  page.off('download', take)
  return Promise.all(found.map(async (one) => ({ name: one.suggestedFilename(), text: readFileSync(await one.path(), 'utf8') })))
}

// The file by another program's eyes: a list of sides.
function read(folder, { name, text }, mesh) {
  const file = join(folder, name)
  writeFileSync(file, text)
  const done = spawnSync('python3', [reader, file, mesh ?? ''], { encoding: 'utf8' })
  assert.equal(done.status, 0, done.stderr)
  return JSON.parse(done.stdout)
}

test('markers in every format', async (t) => {
  const { folder, page, meshes } = await pair(t)
  await step(page, 'Markers')
  for (const [format, files, hasNames, hasMissing] of [
    ['csv', 1, true, true], ['pp', 2, true, true], ['fcsv', 2, true, true], ['mrk.json', 2, true, true],
    ['json', 2, false, false], ['pts', 2, true, true], ['tps', 1, false, true],
  ])
    await t.test(format, async () => {
      await put(page, all)
      await saved(page)
      const written = await downloads(page, files, () => page.getByLabel('Export markers as').selectOption(format))
      written.sort((one, other) => (one.name < other.name ? -1 : 1))
      assert.deepEqual(written.map((one) => one.name), files === 1 ? [`markers.${format}`] : [`markers-source.${format}`, `markers-target.${format}`])
      const sides = written.flatMap((one, i) => read(folder, one, meshes[i]))
      assert.equal(sides.length, 2)
      const expected = hasMissing ? all : all.filter((m) => m.source && m.target)
      sides.forEach((points, i) => {
        assert.equal(points.length, expected.length)
        points.forEach(([name, at], k) => {
          const should = expected[k][i === 0 ? 'source' : 'target']
          if (should) near(at, should, `${format} ${k}`)
          else assert.equal(at, null, 'missing stays missing')
          if (hasNames && format !== 'pts') assert.equal(name, expected[k].name)
        })
      })

      await put(page, [])
      await saved(page)
      await drop(page, '.panel', written)
      await page.waitForFunction((n) => window.studio.store.document.markers.length === n, expected.length)
      const back = await markers(page)
      for (const one of expected) {
        const same = back.find((m) => m.source && one.source ? Math.hypot(...m.source.map((v, k) => v - one.source[k])) < 1e-5 : m.target && one.target && Math.hypot(...m.target.map((v, k) => v - one.target[k])) < 1e-5)
        assert.ok(same, `${one.name} comes back from ${format}`)
        for (const side of ['source', 'target'])
          if (one[side]) near(same[side], one[side], `${format} ${one.name}`)
          else assert.equal(same[side], null)
        if (hasNames && format !== 'pts') assert.equal(same.name, one.name)
      }
    })
  assert.deepEqual(page.problems, [])
})

test('one side alone, files in the wrong order, and markers off their model', async (t) => {
  const { page } = await pair(t)
  await step(page, 'Markers')
  const table = (list) => ['name,x,y,z', ...list.map(([name, at]) => [name, ...at].join())].join('\n') + '\n'
  const list = across.slice(0, 4).map((at, i) => [`p${i}`, at])
  const told = page.locator('.note')

  await t.test('a list of one side goes where its points lie', async () => {
    await drop(page, '.panel', [{ name: 'list.csv', text: table(list.map(([name, at]) => [name, there(at)])) }])
    await told.filter({ hasText: 'lie on the target' }).waitFor()
    const found = await markers(page)
    assert.equal(found.length, 4)
    assert.ok(found.every((m) => m.source === null && m.target))
    await drop(page, '.panel', [{ name: 'other.csv', text: table(list) }])
    await page.waitForFunction(() => window.studio.store.document.markers.every((m) => m.source && m.target))
    assert.equal((await markers(page)).length, 4, 'of the same names: their other side')
  })

  await t.test('where nothing tells, the person does', async () => {
    await put(page, [])
    await drop(page, '.panel', [{ name: 'mixed.csv', text: table([['a', [1, 0, 0]], ['b', [-1, 0, 0]], ['c', there([0, 0, 1])]]) }])
    await page.getByRole('dialog').getByRole('button', { name: /The source/ }).click()
    await page.waitForFunction(() => window.studio.store.document.markers.length === 3)
    assert.ok((await markers(page)).every((m) => m.source && !m.target))
  })

  await t.test('two files in the wrong order are swapped, with a word', async () => {
    await put(page, [])
    await drop(page, '.panel', [{ name: 'one.csv', text: table(list.map(([name, at]) => [name, there(at)])) }, { name: 'two.csv', text: table(list) }])
    await told.filter({ hasText: 'one.csv lies on the target and two.csv on the source: the two files are taken the other way round' }).waitFor()
    const found = await markers(page)
    assert.deepEqual(found.map((m) => m.source), list.map(([, at]) => at))
  })

  await t.test('the fit warns of what lies off the surface, and what it names can be clicked', async () => {
    await page.evaluate(() => window.studio.store.edit('move', (d) => ({ ...d, markers: d.markers.map((m) => (m.name === 'p2' ? { ...m, source: [0, -2, 0] } : m)) })))
    await saved(page)
    await step(page, 'Fit')
    const warning = page.locator('.warn').filter({ hasText: 'further from the source than 5 %' })
    await warning.waitFor()
    await warning.getByRole('button', { name: 'p2' }).click()
    assert.equal(await page.evaluate(() => window.studio.selected), (await markers(page)).find((m) => m.name === 'p2').id)
    assert.equal(await page.evaluate(() => window.studio.step), 'markers')
  })

  await t.test('texts of exceptions stay inside', async () => {
    for (const [name, text] of [['x.mrk.json', '{"markups": ['], ['x.json', '[1, 2'], ['x.pp', '<PickedPoints'], ['x.csv', '\u0000\u0001']]) {
      await drop(page, '.panel', [{ name, text }])
      await page.waitForFunction((name) => [...document.querySelectorAll('.toasts .bad')].some((one) => one.textContent.includes(name)), name)
    }
    const said = (await page.locator('.toasts').allTextContents()).join('\n')
    for (const inner of ['json.exception', 'std::', 'parse_error', 'syntax error', 'SyntaxError', 'undefined', '/tmp/'])
      assert.ok(!said.includes(inner), `${inner}: ${said}`)
    page.problems = page.problems.filter((problem) => !problem.includes('status of 400')) // as it should be
  })
  assert.deepEqual(page.problems, [])
})
