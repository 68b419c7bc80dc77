// How models look in the views: shadings, wires, the plane of symmetry and its twins.
import assert from 'node:assert/strict'
import { writeFileSync } from 'node:fs'
import { join } from 'node:path'
import test from 'node:test'
import { browser, open, ready, saved, scratch, start } from './studio.mjs'

// A globe with a chart from pole to pole, red on its left half and blue on its right.
function globe(file, radius) {
  const [rings, parts] = [12, 24]
  const lines = []
  const at = (r, p) => r * parts + (p % parts) + 1
  for (let r = 0; r <= rings; ++r)
    for (let p = 0; p < parts; ++p) {
      const [a, b] = [(Math.PI * (r + 0.5)) / (rings + 1), (2 * Math.PI * (p + 0.5)) / parts]
      const [x, y, z] = [Math.sin(a) * Math.sin(b), Math.cos(a), Math.sin(a) * Math.cos(b)]
      lines.push(`v ${radius * x} ${y} ${z} ${x > 0 ? '0.9 0.1 0.1' : '0.1 0.1 0.9'}`)
    }
  lines.push('v 0 1.02 0 0.5 0.5 0.5', 'v 0 -1.02 0 0.5 0.5 0.5')
  for (let r = 0; r <= rings; ++r) for (let p = 0; p <= parts; ++p) lines.push(`vt ${p / parts} ${1 - (r + 0.5) / (rings + 1)}`)
  lines.push('vt 0.5 1', 'vt 0.5 0')
  const uv = (r, p) => r * (parts + 1) + p + 1
  const corner = (r, p) => `${at(r, p)}/${uv(r, p)}`
  const [top, low] = [(rings + 1) * parts + 1, (rings + 1) * (parts + 1) + 1]
  for (let p = 0; p < parts; ++p) {
    for (let r = 0; r < rings; ++r) lines.push(`f ${corner(r, p)} ${corner(r + 1, p)} ${corner(r + 1, p + 1)} ${corner(r, p + 1)}`)
    lines.push(`f ${top}/${low} ${corner(0, p)} ${corner(0, p + 1)}`)
    lines.push(`f ${top + 1}/${low + 1} ${corner(rings, p + 1)} ${corner(rings, p)}`)
  }
  writeFileSync(file, lines.join('\n') + '\n')
  return file
}

// The mean colour of a small square of the page, as it is shown.
async function colourAt(page, x, y) {
  const png = (await page.screenshot({ clip: { x: x - 3, y: y - 3, width: 7, height: 7 } })).toString('base64')
  return page.evaluate(async (png) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (c) => c.charCodeAt(0))], { type: 'image/png' }))
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d')
    context.drawImage(image, 0, 0)
    const { data } = context.getImageData(0, 0, image.width, image.height)
    const mean = [0, 0, 0]
    data.forEach((value, i) => i % 4 < 3 && (mean[i % 4] += value / (data.length / 4)))
    return mean
  }, png)
}

test('shadings, wires and twins', async (t) => {
  const folder = scratch(t)
  const studio = await start(t, join(folder, 'state'), [globe(join(folder, 'a.obj'), 1), globe(join(folder, 'b.obj'), 0.8)])
  const page = await open(await browser(t), studio.address)
  await ready(page)
  const box = await page.locator('[data-view=source]').boundingBox()
  const [left, right] = [-0.16, 0.16].map((dx) => [box.x + (0.5 + dx) * box.width, box.y + 0.5 * box.height])
  const colours = async () => {
    await page.waitForTimeout(300)
    return [await colourAt(page, ...left), await colourAt(page, ...right)]
  }
  const shade = (name) => page.getByRole('group', { name: 'Shading' }).getByRole('button', { name }).click()
  await page.evaluate(() => {
    Object.assign(window.studio.pane('source').pose, { yaw: 0, pitch: 0 })
    window.studio.stage.draw()
  })

  await t.test('the colours of the file', async () => {
    const [l, r] = await colours()
    assert.ok(Math.abs(l[0] - l[2]) < 40 && Math.abs(r[0] - r[2]) < 40, `plain at first: ${l} ${r}`)
    await shade('Colour')
    const [blue, red] = await colours()
    assert.ok(blue[2] > blue[0] + 60 && red[0] > red[2] + 60, `blue on its right, red on its left: ${blue} ${red}`)
  })

  await t.test('the chart', async () => {
    await shade('UV')
    const [a, b] = await colours()
    assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > 25, `other colours at other places of the chart: ${a} ${b}`)
    await shade('Smooth')
    const [l, r] = await colours()
    assert.ok(Math.abs(l[0] - l[2]) < 40 && Math.abs(r[0] - r[2]) < 40, 'plain again')
  })

  await t.test('wires', async () => {
    const shot = () => page.locator('[data-view=source]').screenshot()
    const before = await shot()
    await page.keyboard.press('w')
    await page.waitForTimeout(300)
    assert.ok(!before.equals(await shot()))
    await page.keyboard.press('w')
  })

  await t.test('a marker and its twin', async () => {
    await page.getByRole('navigation').getByRole('button', { name: 'Markers' }).click()
    await page.locator('summary', { hasText: 'Symmetry' }).click()
    await page.getByLabel('A new marker gets its mirror twin').check()
    await page.waitForTimeout(300)
    const at = await page.locator('[data-view=source]').boundingBox()
    await page.mouse.click(at.x + 0.62 * at.width, at.y + 0.45 * at.height)
    await page.waitForFunction(() => window.studio.store.document.markers.length === 2)
    const there = await page.locator('[data-view=target]').boundingBox()
    await page.mouse.click(there.x + 0.6 * there.width, there.y + 0.45 * there.height)
    await page.waitForFunction(() => window.studio.store.document.markers.every((m) => m.source && m.target))
    const [one, twin] = await page.evaluate(() => window.studio.store.document.markers)
    for (const side of ['source', 'target']) {
      assert.ok(Math.abs(one[side][0]) > 0.05, 'off the plane')
      assert.ok(Math.hypot(one[side][0] + twin[side][0], one[side][1] - twin[side][1], one[side][2] - twin[side][2]) < 0.01, `mirrored: ${one[side]} ${twin[side]}`)
    }
    await page.keyboard.press('Control+z')
    await page.keyboard.press('Control+z')
    assert.equal(await page.locator('tr[data-marker]').count(), 0, 'a marker comes and goes with its twin')
    await saved(page)
  })
  assert.deepEqual(page.problems, [])
})
