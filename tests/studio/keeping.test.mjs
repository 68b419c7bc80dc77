// What a person has is kept: other projects, replaced models, names, and what can be undone.
import assert from 'node:assert/strict'
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { ball, browser, drop, open, ready, saved, scratch, start, toast } from './studio.mjs'

const markers = (page) => page.evaluate(() => window.studio.store.document.markers)
const info = (page, side) => page.evaluate((side) => window.studio.info(side), side)
const project = (page) => page.evaluate(() => window.studio.state.project)
const step = (page, name) => page.getByRole('navigation').getByRole('button', { name }).click()
const marker = (name, x, y, z) => ({ id: name, name, source: [x, y, z], target: [x, y, z], locked: false })
const put = (page, list) => page.evaluate((list) => window.studio.store.edit('put markers', (d) => ({ ...d, markers: list })), list)

async function pair(t) {
  const folder = scratch(t)
  const [a, b] = ['a.obj', 'b.obj'].map((name) => join(folder, name))
  writeFileSync(a, ball(1))
  writeFileSync(b, ball(1))
  const state = join(folder, 'state')
  const studio = await start(t, state, [a, b])
  const one = await browser(t)
  const page = await open(one, studio.address)
  await ready(page)
  return { folder, state, studio, one, page }
}

test('a project stays as it is while others are opened', async (t) => {
  const { state, studio, one, page: first } = await pair(t)
  let page = first
  await put(page, [marker('nose', 1, 0, 0), marker('chin', 0, -1, 0)])
  await saved(page)
  const mine = await project(page)

  await t.test('a sample, a pair and a new one get folders of their own', async () => {
    await step(page, 'Models')
    await page.locator('.samples button').first().click()
    await page.waitForFunction((number) => window.studio.state.project.number !== number, mine.number)
    assert.notEqual((await project(page)).file, mine.file)
    const kept = JSON.parse(readFileSync(mine.file, 'utf8'))
    assert.deepEqual(kept.markers.map((m) => m.name), ['nose', 'chin'])
    await ready(page)
    await step(page, 'Models')
    await drop(page, '.panel', [{ name: 'c.obj', text: ball(2) }, { name: 'Тест é.obj', text: ball(3) }])
    await page.waitForFunction(() => window.studio.info('target')?.name === 'Тест é.obj', null, { timeout: 20000 })
    assert.equal((await info(page, 'source')).name, 'c.obj')
    assert.deepEqual(await markers(page), [])
    await step(page, 'Models')
    await page.getByRole('button', { name: 'New', exact: true }).click()
    await page.waitForFunction(() => window.studio.info('source') === null)
    assert.deepEqual(JSON.parse(readFileSync(mine.file, 'utf8')), kept)
  })

  await t.test('they are listed with pictures, and open again', async () => {
    const list = page.locator('.project')
    await list.nth(2).waitFor()
    assert.equal(await list.count(), 3)
    const there = list.filter({ hasText: 'a to b' })
    await page.waitForFunction(() => [...document.querySelectorAll('.project img')].filter((img) => img.complete && img.naturalWidth === 320).length === 3)
    assert.match(await there.textContent(), /2 markers/)
    await there.click()
    await page.waitForFunction((file) => window.studio.state.project.file === file, mine.file)
    await ready(page)
    assert.deepEqual((await markers(page)).map((m) => m.name), ['nose', 'chin'])
  })

  await t.test('undo reaches back over a restart, and over going to another project', async () => {
    await page.locator('[data-view=source]').focus()
    await page.evaluate(() => window.studio.store.edit('rename nose', (d) => ({ ...d, markers: d.markers.map((m) => (m.name === 'nose' ? { ...m, name: 'tip' } : m)) })))
    await saved(page)
    await page.evaluate(() => window.studio.saver.flush(true))
    studio.child.kill('SIGKILL')
    await studio.ended
    await page.context().close()
    const again = await start(t, state)
    page = await open(one, again.address)
    await ready(page)
    assert.deepEqual((await markers(page)).map((m) => m.name), ['tip', 'chin'])
    await page.locator('[data-view=source]').focus()
    await page.keyboard.press('Control+z')
    assert.deepEqual((await markers(page)).map((m) => m.name), ['nose', 'chin'])
    await page.keyboard.press('Control+z')
    assert.deepEqual(await markers(page), [], 'the edit before the other projects')
    await page.keyboard.press('Control+Shift+z')
    await saved(page)
  })

  await t.test('earlier states can be gone back to, and undone', async () => {
    await page.waitForTimeout(1100)
    await put(page, [])
    await saved(page)
    await step(page, 'Models')
    await page.locator('summary', { hasText: 'Earlier states' }).click()
    await page.locator('.states button').filter({ hasText: '2 markers' }).first().click()
    await page.waitForFunction(() => window.studio.store.document.markers.length === 2)
    await page.keyboard.press('Control+z')
    assert.deepEqual(await markers(page), [])
    await page.keyboard.press('Control+Shift+z')
    await saved(page)
  })
  assert.deepEqual(page.problems, [])
})

test('a copy holds the dropped models', async (t) => {
  const folder = scratch(t)
  const studio = await start(t, join(folder, 'state'))
  const one = await browser(t)
  const page = await open(one, studio.address)
  await page.locator('.samples').waitFor()
  await drop(page, '.panel', [{ name: 'c.obj', text: ball(2) }, { name: 'Тест é.obj', text: ball(2.02) }])
  await page.waitForFunction(() => window.studio.info('target'))
  await ready(page)
  await put(page, [marker('nose', 2, 0, 0)])
  await saved(page)
  await step(page, 'Models')
  const [copy] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save a copy' }).click()])
  assert.equal(copy.suggestedFilename(), 'c to Тест é.zip')
  const zip = readFileSync(await copy.path())
  await page.context().close()

  const other = await start(t, join(folder, 'elsewhere'))
  const there = await open(one, other.address)
  await there.locator('.samples').waitFor()
  const [chooser] = await Promise.all([there.waitForEvent('filechooser'), there.getByRole('button', { name: 'Open…' }).last().click()])
  await chooser.setFiles({ name: 'copy.zip', mimeType: 'application/zip', buffer: zip })
  await there.waitForFunction(() => window.studio.info('target')?.name === 'Тест é.obj')
  await ready(there)
  assert.deepEqual((await markers(there)).map((m) => m.name), ['nose'])
  await step(there, 'Models')
  const [again] = await Promise.all([there.waitForEvent('filechooser'), there.getByRole('button', { name: 'Open…' }).last().click()])
  await again.setFiles({ name: 'broken.zip', mimeType: 'application/zip', buffer: zip.subarray(0, 200) })
  await toast(there, 'cannot be unpacked').waitFor()
  assert.equal((await info(there, 'target')).name, 'Тест é.obj')
  assert.deepEqual(there.problems, [])
})

test('replacing a model asks, carries its markers over and can be undone', async (t) => {
  const { page } = await pair(t)
  await put(page, [marker('right', 1, 0, 0), marker('left', -1, 0, 0), marker('top', 0, 1, 0)])
  await saved(page)
  const dialog = page.getByRole('dialog')

  await t.test('a mesh beside the views asks which side it is', async () => {
    await drop(page, '.panel', [{ name: 'new.obj', text: ball(1.04, 0.04) }])
    await dialog.filter({ hasText: 'What is new.obj?' }).waitFor()
    await page.keyboard.press('Escape')
    await dialog.waitFor({ state: 'detached' })
    assert.equal((await info(page, 'target')).name, 'b.obj')
    await drop(page, '.panel', [{ name: 'new.obj', text: ball(1.04, 0.04) }])
    await dialog.getByRole('button', { name: /The target/ }).click()
    await dialog.filter({ hasText: 'Replace b.obj by new.obj?' }).waitFor()
  })

  await t.test('with what becomes of the markers', async () => {
    const text = await dialog.textContent()
    assert.match(text, /Undo brings everything back/)
    const before = await markers(page)
    await dialog.getByRole('button', { name: 'Replace' }).click()
    await page.waitForFunction(() => window.studio.info('target')?.name === 'new.obj')
    const after = await markers(page)
    assert.deepEqual(after.map((m) => m.source), before.map((m) => m.source), "the other side's markers stay")
    const [right, left, top] = after.map((m) => m.target)
    assert.ok(Math.abs(right[0] - 1.08) < 0.01, `put onto the new surface: ${right}`)
    assert.ok(Math.abs(left[0] + 1) < 0.01 && Math.abs(top[1] - 1.04) < 0.01)
    await page.keyboard.press('Control+z')
    await page.waitForFunction(() => window.studio.info('target')?.name === 'b.obj')
    assert.deepEqual(await markers(page), before)
    await page.keyboard.press('Control+Shift+z')
    await page.waitForFunction(() => window.studio.info('target')?.name === 'new.obj')
    await page.keyboard.press('Control+z')
    await page.waitForFunction(() => window.studio.info('target')?.name === 'b.obj')
    await saved(page)
  })

  await t.test('and those that lie nowhere on it become missing', async () => {
    await drop(page, '[data-view=source]', [{ name: 'far.obj', text: ball(1, 0.5) }])
    await dialog.filter({ hasText: 'Replace a.obj by far.obj?' }).waitFor()
    assert.match(await dialog.textContent(), /missing on the source: .*right/)
    await dialog.getByRole('button', { name: 'Replace' }).click()
    await page.waitForFunction(() => window.studio.info('source')?.name === 'far.obj')
    const [right] = await markers(page)
    assert.equal(right.source, null)
    assert.deepEqual(right.target, [1, 0, 0])
    await page.keyboard.press('Control+z')
    await page.waitForFunction(() => window.studio.info('source')?.name === 'a.obj')
  })
  assert.deepEqual(page.problems, [])
})

test('faces and vertices that a card names can be clicked', async (t) => {
  const folder = scratch(t)
  writeFileSync(join(folder, 'a.obj'), ball(1) + 'f 1 2 21\nf 1 22 43\nf 5 6 30\n')
  writeFileSync(join(folder, 'b.obj'), ball(1))
  const studio = await start(t, join(folder, 'state'), [join(folder, 'a.obj'), join(folder, 'b.obj')])
  const page = await open(await browser(t), studio.address)
  await ready(page)
  await step(page, 'Models')
  const named = page.locator('[data-side=source] button.link')
  const before = await page.evaluate(() => window.studio.pane('source').pose.distance)
  const text = await named.first().textContent()
  assert.match(text, /^\d+(-\d+)?$/)
  await named.first().click()
  await page.waitForFunction((before) => window.studio.pane('source').pose.distance < before / 2, before)
  assert.deepEqual(page.problems, [])
})

test('names, fields and files that are none', async (t) => {
  const { folder, page } = await pair(t)
  await put(page, [marker('nose', 1, 0, 0), marker('chin', 0, -1, 0)])
  await saved(page)
  await step(page, 'Markers')
  const name = page.locator('tr[data-marker] input').first()

  await t.test('a blank name and one that is taken are refused kindly', async () => {
    await name.fill('   ')
    await page.keyboard.press('Enter')
    await toast(page, 'still “nose”').waitFor()
    await name.fill('chin')
    await page.keyboard.press('Enter')
    await toast(page, 'Another marker is called “chin”').waitFor()
    assert.equal(await name.inputValue(), 'nose')
    assert.deepEqual((await markers(page)).map((m) => m.name), ['nose', 'chin'])
  })

  await t.test("Ctrl+Z in a field is the field's own", async () => {
    await name.focus()
    await page.keyboard.press('End')
    await page.keyboard.type(' tip')
    assert.equal(await name.inputValue(), 'nose tip')
    await page.keyboard.press('Control+z')
    assert.equal(await name.inputValue(), 'nose')
    assert.equal((await markers(page)).length, 2, 'no edit of the project was undone')
    await page.keyboard.press('Escape')
  })

  await t.test('what cannot be taken is told at once', async () => {
    const before = await page.evaluate(() => performance.getEntriesByType('resource').filter((one) => one.name.includes('upload')).length)
    await drop(page, '[data-view=source]', [{ name: 'photo.jpg', text: 'x', type: 'image/jpeg' }])
    await toast(page, 'photo.jpg is a picture').waitFor()
    await drop(page, '[data-view=source]', [{ name: 'huge.ply', text: 'ply', size: 3 * 2 ** 30 }])
    await toast(page, 'huge.ply has 3.00 GB').waitFor()
    await drop(page, '[data-view=source]', [{ name: 'notes.docx', text: 'x' }])
    await toast(page, 'notes.docx is nothing that the studio reads').waitFor()
    await drop(page, '[data-view=source]', [{ name: 'empty.obj', text: '' }])
    await toast(page, 'empty.obj is empty').waitFor()
    const after = await page.evaluate(() => performance.getEntriesByType('resource').filter((one) => one.name.includes('upload')).length)
    assert.equal(after, before, 'nothing was sent')
  })

  await t.test('nor a folder', async () => {
    mkdirSync(join(folder, 'models'))
    writeFileSync(join(folder, 'models', 'x.obj'), ball(1))
    const box = await page.locator('[data-view=source]').boundingBox()
    const client = await page.context().newCDPSession(page)
    const data = { items: [], files: [join(folder, 'models')], dragOperationsMask: 1 }
    for (const type of ['dragEnter', 'dragOver', 'drop'])
      await client.send('Input.dispatchDragEvent', { type, x: box.x + 50, y: box.y + 80, data })
    await toast(page, 'models is a folder').waitFor()
    assert.equal((await info(page, 'source')).name, 'a.obj')
  })

  await t.test('an upload shows how far it is, and stops', async () => {
    await page.evaluate(() => {
      const send = XMLHttpRequest.prototype.send
      XMLHttpRequest.prototype.send = function () {
        XMLHttpRequest.prototype.send = send // held back: as over a slow line
        setTimeout(() => this.upload.onprogress({ lengthComputable: true, loaded: 1, total: 4 }), 50)
      }
      const abort = XMLHttpRequest.prototype.abort
      XMLHttpRequest.prototype.abort = function () {
        abort.call(this)
        this.onabort?.()
      }
    })
    await drop(page, '[data-view=source]', [{ name: 'slow.obj', text: ball(2) }])
    const bar = page.locator('.busy progress')
    await bar.waitFor()
    await page.waitForFunction(() => document.querySelector('.busy progress')?.value === 0.25)
    await page.locator('.busy').getByRole('button').click()
    await toast(page, 'Stopped. Nothing has changed.').waitFor()
    assert.equal((await info(page, 'source')).name, 'a.obj')
  })
  assert.deepEqual(page.problems, [])
})
