// Each of these requests must fail; the last lines show that the same request, made rightly, does not.
import assert from 'node:assert/strict'
import { request } from 'node:http'
import { mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs'
import { connect } from 'node:net'
import { networkInterfaces } from 'node:os'
import { join } from 'node:path'
import test from 'node:test'
import { run, scratch, start } from './studio.mjs'

const ask = (studio, path, { method = 'GET', headers = {}, body = '', host = '127.0.0.1' } = {}) =>
  new Promise((resolve, reject) => {
    const question = request(
      { host, port: studio.url.port, path, method, agent: false, headers: { 'Content-Length': Buffer.byteLength(body), ...headers } },
      (answer) => {
        const parts = []
        answer.on('data', (part) => parts.push(part))
        answer.on('end', () => resolve({ status: answer.statusCode, headers: answer.headers, text: Buffer.concat(parts).toString() }))
      },
    )
    question.on('error', reject)
    question.end(body)
  })

test('refuses whoever is not the page', async (t) => {
  const folder = scratch(t)
  assert.equal(run('sample', 'bar-bend', '-o', folder).status, 0)
  const meshes = ['source', 'target'].map((side) => join(folder, `bar-bend_${side}.ply`))
  const studio = await start(t, join(folder, 'state'), meshes)
  const root = studio.url.pathname
  const state = `${root}api/state`
  const own = `127.0.0.1:${studio.url.port}`
  const get = (path, options) => ask(studio, path, options)
  const post = (path, body, headers = {}) => ask(studio, path, { method: 'POST', body, headers })

  await t.test('without the token, or with another', async () => {
    for (const path of ['/', '/api/state', '/index.html', `/${'0'.repeat(32)}/api/state`, `${root.slice(0, -2)}/api/state`])
      assert.equal((await get(path)).status, 403, path)
    assert.equal((await post('/api/new', '')).status, 403)
  })

  await t.test('under a rebound name', async () => {
    for (const host of ['evil.example', `evil.example:${studio.url.port}`, '127.0.0.1', `[::1]:${studio.url.port}`])
      assert.equal((await get(state, { headers: { Host: host } })).status, 403, host)
  })

  await t.test('from a foreign page', async () => {
    for (const origin of ['https://evil.example', 'null', `https://${own}`, 'http://127.0.0.1:1'])
      for (const method of ['GET', 'POST'])
        assert.equal((await get(state, { method, headers: { Origin: origin } })).status, 403, origin)
    for (const site of ['cross-site', 'same-site'])
      assert.equal((await get(state, { headers: { 'Sec-Fetch-Site': site } })).status, 403, site)
  })

  await t.test('on another address of this machine', async () => {
    const others = Object.values(networkInterfaces()).flat().filter((one) => one.family === 'IPv4' && !one.internal)
    for (const { address } of others) {
      const answer = await new Promise((resolve) => {
        const socket = connect({ host: address, port: studio.url.port, timeout: 2000 })
        socket.on('connect', () => resolve('open')).on('error', () => resolve('closed')).on('timeout', () => resolve('closed'))
      })
      assert.equal(answer, 'closed', address)
    }
  })

  await t.test('what lies outside the project', async () => {
    writeFileSync(join(folder, 'secret.ply'), readFileSync(meshes[0]))
    const bundle = (files) => JSON.stringify(files.map(([name, text]) => ({ name, size: Buffer.byteLength(text) }))) + '\n' + files.map(([, text]) => text).join('')
    const project = (path) => bundle([['project.json', JSON.stringify({ meshtween_project: 1, source: { path, hash: '' }, markers: [] })]])
    for (const path of [join(folder, 'secret.ply'), '../../../../secret.ply', '/etc/passwd']) {
      const answer = await post(`${root}api/projects/add`, project(path), { 'X-Tab': '' })
      assert.equal(answer.status, 400, path)
      assert.match(answer.text, /open that file first/)
    }
    for (const name of ['../escaped.ply', '/tmp/escaped.ply', 'a/b/c/d.ply'])
      assert.equal((await post(`${root}api/projects/add`, bundle([['project.json', '{"meshtween_project":1}'], [name, 'x']]))).status, 400, name)
    for (const id of ['..', '', '../..', '%2e%2e', 'x/../..']) {
      assert.equal((await post(`${root}api/projects/open?id=${id}`, '')).status, 400, id)
      assert.equal((await get(`${root}api/projects/picture?id=${id}`)).status, 400, id)
      assert.equal((await get(`${root}api/kept?name=${id}`)).status, 400, id)
    }
    const reach = (path) => JSON.stringify({ models: { source: { path, hash: '' }, target: null } })
    for (const path of ['/etc/passwd', '../../../../secret.ply', join(folder, 'secret.ply')])
      assert.equal((await post(`${root}api/document`, reach(path))).status, 400, path)
    const inside = JSON.parse((await get(state)).text).project.folder
    symlinkSync(join(folder, 'secret.ply'), join(inside, 'link.ply'))
    assert.equal((await post(`${root}api/document`, reach('link.ply'))).status, 400)
    mkdirSync(join(inside, 'exports'), { recursive: true })
    symlinkSync('/etc/passwd', join(inside, 'exports', 'link.glb'))
    for (const name of ['../project.json', '/etc/passwd', '..%2f..%2fsecret.ply', 'link.glb', ''])
      assert.equal((await get(`${root}api/download?name=${name}`)).status, 400, name)
    symlinkSync(join(folder, 'secret.ply'), join(inside, 'models.link'))
    symlinkSync(join(folder), join(inside, 'models'))
    assert.equal((await post(`${root}api/upload?side=source&name=secret.ply`, readFileSync(meshes[1]))).status, 400)
    rmSync(join(inside, 'models'))
    for (const path of [`${root}../../etc/passwd`, `${root}%2e%2e/%2e%2e/etc/passwd`, `${root}api/mesh/../../project.json`])
      assert.equal((await get(path)).status, 404, path)
    const upload = await post(`${root}api/upload?side=target&name=..%2F..%2Fescaped.ply`, readFileSync(meshes[0]))
    assert.equal(upload.status, 200)
    assert.match(JSON.parse(upload.text).model.path, /^models\/[0-9a-f]{16}\/escaped\.ply$/)
  })

  await t.test('hostile files and requests, with an error and no crash', async () => {
    const before = JSON.parse((await get(state)).text).meshes.target
    const hostile = {
      'empty.ply': '', 'garbage.obj': '\0\x01\xff'.repeat(1000), 'short.ply': 'ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n',
      'index.obj': 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n', 'nan.obj': 'v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n',
      'outside.gltf': '{"asset":{"version":"2.0"},"buffers":[{"uri":"../../../../etc/passwd","byteLength":10}]}',
      'kind.exe': 'x', '..': 'x', 'deep.gltf': '['.repeat(200000),
    }
    for (const [name, body] of Object.entries(hostile)) {
      const answer = await post(`${root}api/upload?side=target&name=${encodeURIComponent(name)}`, body)
      assert.equal(answer.status, 400, name)
      assert.ok(JSON.parse(answer.text).error.length > 5)
    }
    assert.deepEqual(JSON.parse((await get(state)).text).meshes.target, before)
    for (const [path, body] of [
      ['api/document', '{'], ['api/document', '[]'], ['api/document', '{"markers":[{"id":"a","source":[1,2]}]}'],
      ['api/document', '{"markers":[{"id":"a"},{"id":"a"}]}'], ['api/document', `{"markers":${'['.repeat(100000)}`],
      ['api/document', '{"options":{"fit":{"rounds":-1}}}'], ['api/guess?from=up', '[]'], ['api/guess?from=source', '[[1,2,"x"]]'],
      ['api/fit', '{"nonsense":1}'], ['api/export', '{"names":["../../x.glb"]}'], ['api/projects/add', 'null'], ['api/projects/add', '[{"name":"project.json","size":9}]\n{}'],
      ['api/picture', 'x'], ['api/document?project=99', '{}'], ['api/document?project=x', '{}'],
      ['api/markers/import?name=x.csv', '\xff\xfe'], ['api/morph', '{}'],
    ])
      assert.equal((await post(root + path, body)).status, 400, `${path} ${body.slice(0, 40)}`)
    for (const path of ['api/mesh?side=source&what=secrets', 'api/path?key=x&node=-1&what=positions', 'api/fitted?what=distance', 'api/mesh'])
      assert.equal((await get(root + path)).status, 400, path)
  })

  await t.test('too much', async () => {
    assert.equal((await post(`${root}api/cancel`, 'x'.repeat(2 << 20))).status, 413)
    const chunked = await post(`${root}api/cancel`, 'x'.repeat(2 << 20), { 'Content-Length': undefined, 'Transfer-Encoding': 'chunked' })
      .then((answer) => answer.status, () => 'closed')
    assert.ok(chunked === 413 || chunked === 'closed', `${chunked}`)
    assert.ok([414, 400].includes((await get(`${root}${'a'.repeat(20000)}`)).status))
  })

  await t.test('a second tab', async () => {
    const answer = await post(`${root}api/document`, '{"markers":[]}', { 'X-Tab': 'nobody' })
    assert.equal(answer.status, 409)
    assert.match(answer.text, /another tab/)
  })

  await t.test('but answers the page', async () => {
    const answer = await get(state, { headers: { Origin: `http://${own}`, 'Sec-Fetch-Site': 'same-origin' } })
    assert.equal(answer.status, 200)
    assert.equal(answer.headers['x-frame-options'], 'DENY')
    assert.match(answer.headers['content-security-policy'], /default-src 'none'/)
    assert.equal(answer.headers['access-control-allow-origin'], undefined)
    assert.equal((await get(root)).status, 200)
  })

  await t.test('and ends when it is told to', async () => {
    studio.child.kill('SIGTERM')
    assert.equal((await studio.ended).signal ?? 'none', 'none')
  })
})
