// The pictures of docs/studio.md: MESHTWEEN_PROGRAM=build/release/apps/cli/meshtween node tools/studio_pictures.mjs FOLDER [SOURCE TARGET MARKERS]
// Takes the tour with the embedded sample, or with the models named, in light and dark at 1280x720 and 1920x1080.
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join, resolve } from 'node:path'
import { browser, open, ready, run, saved, start } from '../tests/studio/studio.mjs'

const [folder, ...given] = process.argv.slice(2)
const work = mkdtempSync(join(tmpdir(), 'meshtween-pictures-'))
const last = []
const t = { after: (what) => last.push(what) }
mkdirSync(folder, { recursive: true })
const [source, target, markers] = given.length === 3 ? given.map((file) => resolve(file))
  : (run('sample', 'bow', '-o', work), ['source.ply', 'target.ply', 'markers.csv'].map((end) => join(work, `bow_${end}`)))

const looks = [['light', 1280, 720], ['dark', 1280, 720], ['light', 1920, 1080], ['dark', 1920, 1080]]

// Leaves some projects in the list of recent ones, and comes back.
async function visitSamples(page) {
  const mine = await page.evaluate(() => window.studio.state.project.id)
  for (const name of ['head', 'arms', 'bow']) {
    await step(page, 'Models')
    await page.locator('.samples button').filter({ has: page.getByText(name, { exact: true }) }).click()
    await page.waitForFunction((name) => window.studio.info('target')?.name.startsWith(name), name)
    await ready(page)
    await page.waitForTimeout(1500) // for its picture
  }
  await step(page, 'Models')
  await page.locator('.project').last().click()
  await page.waitForFunction((id) => window.studio.state.project.id === id, mine)
  await ready(page)
}

const step = (page, name) => page.getByRole('navigation').getByRole('button', { name }).click()

try {
  const studio = await start(t, join(work, 'state'), [source, target])
  const one = await browser(t)
  const pages = []
  for (const [scheme, width, height] of looks) {
    const page = await open(one, studio.address, { width, height }, scheme)
    pages.push(page)
    const shot = async (name) => {
      await page.evaluate(() => window.studio.set({ toasts: [] }))
      await page.waitForTimeout(700)
      await page.screenshot({ path: join(folder, `${name}-${scheme}-${width}.png`) })
    }
    await ready(page)
    if (page === pages[0]) await visitSamples(page)
    await step(page, 'Models')
    await page.waitForFunction(() => [...document.querySelectorAll('.project img')].every((img) => img.naturalWidth > 0))
    await shot('models')
    await page.evaluate(() => document.querySelector('.panel').scrollTo(0, 420))
    await shot('projects')
    await step(page, 'Markers')
    if ((await page.locator('tr[data-marker]').count()) === 0) {
      const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.getByRole('button', { name: 'Import…' }).click()])
      await chooser.setFiles(markers)
      await page.locator('tr[data-marker]').first().waitFor()
      await saved(page)
    }
    await page.locator('tr[data-marker]').nth(4).locator('td.number').click()
    await shot('markers')
    await page.keyboard.press('n')
    await page.locator('.ghost').waitFor()
    await shot('suggest')
    await page.keyboard.press('Escape')
    await page.keyboard.press('Home')
    await step(page, 'Fit')
    if (!(await page.evaluate(() => window.studio.state.fit !== null))) {
      await page.getByRole('button', { name: 'Fit', exact: true }).last().click()
      await page.waitForTimeout(1500)
      await shot('fitting')
    }
    await page.locator('.figures').waitFor({ timeout: 600000 })
    await shot('fit')
    await step(page, 'Morph')
    await page.getByRole('button', { name: 'Morph', exact: true }).last().click()
    await page.getByLabel('Place between source').waitFor({ timeout: 600000 })
    await page.getByLabel('Place between source').fill('0.5')
    await shot('morph')
    await page.getByLabel('Compare with').selectOption('linear')
    await page.locator('[data-view=compare]').waitFor({ timeout: 600000 })
    await page.keyboard.press('1')
    await page.keyboard.press('2')
    await shot('compare')
    await step(page, 'Export')
    await shot('export')
    await page.keyboard.press('?')
    await shot('help')
    console.log(scheme, width, page.problems.join('\n'))
    await page.context().close()
  }
} finally {
  for (const what of last.reverse()) await what()
  rmSync(work, { recursive: true, force: true })
}
