// The whole job in a browser against the real program: open, place, undo, save, reload, fit, morph, export, crash.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { browser, models, open, ready, run, saved, scratch, start } from './studio.mjs'

// Six places on the model in a view, in parts of the view's size, none close to another.
const placesIn = (page, side) =>
  page.evaluate((side) => {
    const pane = window.studio.pane(side)
    const { clientWidth, clientHeight } = pane.element
    const hit = (x, y) => pane.hit(x * clientWidth, y * clientHeight) !== null
    const well = (x, y) => hit(x, y) && hit(x - 0.02, y) && hit(x + 0.02, y) && hit(x, y - 0.02) && hit(x, y + 0.02)
    const found = []
    for (let y = 0.2; y < 0.8; y += 0.03)
      for (let x = 0.2; x < 0.8; x += 0.03)
        if (well(x, y) && found.every(([p, q]) => Math.hypot((p - x) * clientWidth, (q - y) * clientHeight) > 40))
          found.push([x, y])
    return found.slice(0, 6)
  }, side)

const click = async (page, side, [x, y]) => {
  const box = await page.locator(`[data-view=${side}]`).boundingBox()
  await page.mouse.click(box.x + x * box.width, box.y + y * box.height)
}
const rows = (page) => page.locator('tr[data-marker]')
const complete = (page) => page.locator('.status.both')
const markers = (page) => page.evaluate(() => window.studio.store.document.markers)
const step = (page, name) => page.getByRole('navigation').getByRole('button', { name }).click()

async function importMarkers(page, file, count = 4) {
  const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.getByRole('button', { name: 'Import…' }).click()])
  await chooser.setFiles(file)
  await page.waitForFunction((count) => window.studio.store.document.markers.length >= count, count)
  await saved(page)
}

async function fit(page) {
  await step(page, 'Fit')
  await page.getByRole('button', { name: /^Fit( again)?$/ }).last().click()
  await page.locator('.figures').waitFor({ timeout: 240000 })
}

// The chunks of a GLB.
function glb(bytes) {
  const length = bytes.readUInt32LE(12)
  return { json: JSON.parse(bytes.subarray(20, 20 + length)), bin: bytes.subarray(28 + length) }
}

test('place six, undo two, reload, find the rest', async (t) => {
  const folder = scratch(t)
  const { source, target } = models(folder)
  const studio = await start(t, join(folder, 'state'), [source, target])
  const page = await open(await browser(t), studio.address)
  await ready(page)
  const places = { source: await placesIn(page, 'source'), target: await placesIn(page, 'target') }
  assert.equal(places.source.length + places.target.length, 12)
  for (let i = 0; i < 6; ++i) {
    const count = await rows(page).count()
    await click(page, 'source', places.source[i])
    await page.waitForFunction((n) => window.studio.store.document.markers.length === n, count + 1)
    await click(page, 'target', places.target[i])
    await page.waitForFunction((n) => window.studio.store.document.markers.filter((m) => m.source && m.target).length === n, count + 1)
  }
  assert.equal(await complete(page).count(), 6)
  await page.keyboard.press('Control+z')
  await page.keyboard.press('Control+z')
  assert.equal(await rows(page).count(), 5)
  await page.keyboard.press('Control+Shift+z')
  assert.equal(await rows(page).count(), 6)
  await page.keyboard.press('Control+z')
  await rows(page).first().locator('input').fill('nose')
  await page.keyboard.press('Enter')
  await saved(page)
  const before = await markers(page)
  await page.reload()
  await ready(page)
  assert.deepEqual(await markers(page), before)
  assert.equal(await rows(page).count(), 5)
  assert.equal(await rows(page).first().locator('input').inputValue(), 'nose')
  await page.locator('[data-view=source]').focus()
  await page.keyboard.press('Control+z')
  assert.notEqual(await rows(page).first().locator('input').inputValue(), 'nose', 'undo reaches back over the reload')
  await page.keyboard.press('Control+Shift+z')
  assert.deepEqual(await markers(page), before)

  // Dragging turns the view; a marker moves only when it is selected and not locked.
  await page.keyboard.press('Escape')
  const box = await page.locator('[data-view=source]').boundingBox()
  const at = await page.evaluate(() => {
    const pane = window.studio.pane('source')
    const place = pane.pins.pins[0].at.clone().project(pane.camera)
    return [(place.x + 1) / 2, (1 - place.y) / 2]
  })
  const drag = async () => {
    await page.mouse.move(box.x + at[0] * box.width, box.y + at[1] * box.height)
    await page.mouse.down()
    await page.mouse.move(box.x + at[0] * box.width + 15, box.y + at[1] * box.height + 15, { steps: 4 })
    await page.mouse.up()
  }
  const pose = await page.evaluate(() => window.studio.pane('source').pose.yaw)
  await drag()
  assert.deepEqual(await markers(page), before, 'nothing is selected: nothing moves')
  await page.evaluate((yaw) => Object.assign(window.studio.pane('source').pose, { yaw, pitch: 0.15 }), pose)
  await rows(page).first().locator('td.number').click()
  await drag()
  assert.notDeepEqual((await markers(page))[0].source, before[0].source)
  assert.deepEqual((await markers(page)).slice(1), before.slice(1))
  await page.keyboard.press('Control+z')
  assert.deepEqual(await markers(page), before, 'a drag is one edit')
  await saved(page)
  assert.deepEqual(page.problems, [])
})

test('import, fit, morph, export, crash, go on', async (t) => {
  const folder = scratch(t)
  const { source, target, markers: file } = models(folder)
  const state = join(folder, 'state')
  let studio = await start(t, state, [source, target])
  const one = await browser(t)
  let page = await open(one, studio.address)
  await ready(page)
  await importMarkers(page, file)
  const stored = await complete(page).count()
  assert.ok(stored >= 10)
  const imported = await markers(page)
  await page.evaluate(() => window.studio.store.edit('lose one, move one', (d) => ({ ...d, markers: d.markers.slice(1).map((m, i) => (i === 0 ? { ...m, source: m.target } : m)) })))
  await importMarkers(page, file, stored)
  const again = await markers(page)
  const places = (list) => list.map(({ name, source, target }) => ({ name, source, target })).sort((a, b) => (a.name < b.name ? -1 : 1))
  assert.deepEqual(places(again), places(imported), 'names tell which markers of a file are there already')
  await fit(page)
  await step(page, 'Markers')
  const errors = (await page.locator('td.error').allTextContents()).map((text) => Number(text.replace('<', '')))
  assert.equal(errors.length, stored)
  assert.ok(errors.every((error) => error >= 0 && error < 5), String(errors))

  await t.test('scrub the morph', async () => {
    await step(page, 'Morph')
    await page.getByRole('button', { name: 'Morph', exact: true }).last().click()
    const slider = page.getByLabel('Place between source')
    await slider.waitFor({ timeout: 240000 })
    await slider.fill('0.5')
    const shown = () => page.evaluate(() => window.studio.result.influences)
    const half = await shown()
    assert.ok(Math.abs(half.reduce((a, b) => a + b, 0) - 1) < 1e-6)
    await slider.fill('1')
    assert.equal((await shown()).at(-1), 1)
    await page.getByRole('button', { name: 'play', exact: true }).click()
    await page.waitForFunction(() => window.studio.result.influences.at(-1) !== 1)
    await page.getByRole('button', { name: 'pause', exact: true }).click()
  })

  await t.test('paint the timing', async () => {
    const dabs = () => page.evaluate(() => window.studio.store.document.timing.dabs.length)
    await page.keyboard.press('b')
    await page.locator('[data-view=source]').waitFor()
    const [x, y] = (await placesIn(page, 'source'))[0]
    const box = await page.locator('[data-view=source]').boundingBox()
    const at = [box.x + x * box.width, box.y + y * box.height]
    await page.mouse.move(...at)
    await page.mouse.down()
    await page.mouse.move(at[0] + 8, at[1] + 8, { steps: 4 })
    await page.mouse.up()
    assert.ok((await dabs()) > 0)
    const yellow = await page.evaluate(() => window.studio.models.source.geometry.getAttribute('color').array.filter((v, i) => i % 4 === 0 && v !== 68).length)
    assert.ok(yellow > 0, 'the painted place has the colour of its moment')
    await page.keyboard.press('Control+z')
    assert.equal(await dabs(), 0, 'a stroke is one edit')
    await page.keyboard.press('b')
    assert.equal(await page.evaluate(() => window.studio.models.source.geometry.hasAttribute('color')), false)
    await saved(page)
  })

  await t.test("the exported GLB is the command line's", async () => {
    await step(page, 'Export')
    const [download] = await Promise.all([
      page.waitForEvent('download', { timeout: 240000 }),
      page.getByRole('button', { name: 'Export', exact: true }).last().click(),
    ])
    const ours = glb(readFileSync(await download.path()))
    const done = run('morph', source, target, '--markers', file, '-o', join(folder, 'cli.glb'), '--quiet')
    assert.equal(done.status, 0, done.err)
    const theirs = glb(readFileSync(join(folder, 'cli.glb')))
    assert.deepEqual(ours.json.accessors, theirs.json.accessors)
    assert.ok(ours.bin.equals(theirs.bin), 'the same vertices, bit for bit')
  })

  await t.test('cancel a fit halfway', async () => {
    await step(page, 'Fit')
    const before = await page.locator('.figures').textContent()
    await page.evaluate(() => {
      const { store } = window.studio
      const options = { ...store.document.options, fit: { rounds: 1000, threshold: 1e-9 } }
      store.edit('many rounds', (d) => ({ ...d, options }))
    })
    await page.getByRole('button', { name: 'Fit again' }).click()
    await page.waitForFunction(() => window.studio.job.state === 'running' && window.studio.job.fraction > 0)
    await page.getByRole('button', { name: 'Cancel' }).click()
    await page.waitForFunction(() => window.studio.job.state === 'cancelled', null, { timeout: 60000 })
    assert.equal(await page.locator('.figures').textContent(), before, 'the fit before is still there')
    await page.keyboard.press('Control+z')
    await saved(page)
  })

  await t.test('kill -9, start again, lose nothing', async () => {
    await step(page, 'Markers')
    await rows(page).nth(2).locator('input').fill('the last thing I did')
    await page.keyboard.press('Enter')
    await saved(page)
    const before = await markers(page)
    const figures = await page.evaluate(() => window.studio.state.fit.quality)
    studio.child.kill('SIGKILL')
    assert.equal((await studio.ended).signal, 'SIGKILL')
    await page.getByRole('alert').filter({ hasText: 'does not answer' }).waitFor()
    await page.context().close()
    studio = await start(t, state)
    page = await open(one, studio.address)
    await ready(page)
    assert.deepEqual(await markers(page), before)
    assert.deepEqual(await page.evaluate(() => window.studio.state.fit.quality), figures)
    assert.deepEqual(page.problems, [])
  })

  await t.test('a second tab is told, and can take over', async () => {
    const second = await open(one, studio.address)
    const told = second.getByRole('alert').filter({ hasText: 'another tab' })
    await told.waitFor()
    await second.getByRole('button', { name: 'Edit here instead' }).click()
    await told.waitFor({ state: 'detached' })
    await page.getByRole('alert').filter({ hasText: 'another tab' }).waitFor()
    await second.context().close()
    await page.getByRole('alert').filter({ hasText: 'another tab' }).waitFor({ state: 'detached' })
  })
})
