// A page whose stream of events broke hears, when it comes back, what it missed.
import assert from 'node:assert/strict'
import { get } from 'node:http'
import test from 'node:test'
import { scratch, start } from './studio.mjs'

// What a stream tells until it has told `last`.
const listen = (studio, last, headers = {}) =>
  new Promise((resolve, reject) => {
    const asked = get(new URL('api/events?tab=one', studio.url), { headers, agent: false }, (stream) => {
      let told = ''
      stream.on('data', (text) => {
        told += text
        if (!told.includes(last)) return
        asked.destroy()
        resolve(told)
      })
    })
    asked.on('error', (error) => error.code !== 'ECONNRESET' && reject(error))
    asked.setTimeout(30000, () => reject(new Error(`nothing like ${last} came`)))
  })

test('goes on where it stopped', async (t) => {
  const studio = await start(t, scratch(t))
  const first = await listen(studio, '"editor":"one"}')
  const id = Number(/id: (\d+)/.exec(first)[1])
  await listen(studio, `id: ${id + 1}\n`) // has happened from here on
  const fresh = await listen(studio, 'data: ')
  assert.ok(!fresh.includes(`id: ${id + 1}\n`))
  const resumed = await listen(studio, 'data: ', { 'Last-Event-ID': String(id) })
  assert.ok(resumed.includes(`id: ${id + 1}\n`))
  assert.ok(!resumed.includes(`id: ${id}\n`))
})
