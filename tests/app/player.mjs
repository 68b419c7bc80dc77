// An exported page in headless Chromium: it shows the curve's vertices, loads nothing, and answers to keys.
// player.mjs FOLDER: reads morph.html, path.html, keys.html, far.html and their .json, leaves screenshots beside them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const folder = process.argv[2];
const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader', '--use-gl=angle', '--use-angle=swiftshader',
        '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});

async function opened(name, options = {}) {
    const page = await browser.newPage({ reducedMotion: 'reduce', viewport: { width: 640, height: 480 }, ...options });
    page.setDefaultTimeout(240_000); // a busy machine draws slowly without a graphics card
    const loads = [], complaints = [];
    page.on('request', (request) => loads.push(request.url()));
    page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
    page.on('pageerror', (error) => complaints.push(String(error)));
    const address = pathToFileURL(join(folder, name)).href;
    await page.goto(address);
    await page.evaluate(() => window.meshtween.then(() => undefined));
    return { page, complaints, foreign: () => loads.filter((url) => url !== address && !url.startsWith('data:') && !url.startsWith('blob:')) };
}

async function drawn(page) {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

// The largest distance between the page's vertices and the library's, in parts of the diagonal.
async function checkShapes(page, name, tolerance) {
    const shapes = JSON.parse(readFileSync(join(folder, `${name}.json`), 'utf8'));
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    shapes[0].vertices.forEach((x, i) => {
        low[i % 3] = Math.min(low[i % 3], x);
        high[i % 3] = Math.max(high[i % 3], x);
    });
    const diagonal = Math.hypot(...high.map((x, c) => x - low[c]));
    for (const { u, vertices, weights } of shapes) {
        const [shown, shares] = await page.evaluate((at) => window.meshtween.then((m) => {
            m.setU(at);
            return [Array.from(m.vertices()), m.weights(at)];
        }), u);
        assert.deepEqual(shares, weights, `${name} at ${u}: other weights than the library's`); // to the last bit
        assert.equal(shown.length, vertices.length);
        const worst = shown.reduce((most, x, i) => Math.max(most, Math.abs(x - vertices[i])), 0) / diagonal;
        console.log(`${name} at ${u}: ${worst.toExponential(2)} of the diagonal`);
        assert.ok(worst < tolerance, `${name} at ${u} is ${worst} of the diagonal away from the curve`);
        assert.equal(await page.inputValue('#u'), String(Number(u.toFixed(3))));
    }
    await page.evaluate(() => window.meshtween.then((m) => m.setU(0.5)));
    await drawn(page);
    await page.screenshot({ path: join(folder, `${name}.png`) });
}

async function checkKeys(page) {
    const u = () => page.evaluate(() => window.meshtween.then((m) => m.u()));
    assert.equal(await u(), 0);
    await page.keyboard.press('End');
    assert.equal(await u(), 1);
    await page.keyboard.press('ArrowLeft');
    assert.ok(Math.abs((await u()) - 0.99) < 1e-9);
    await page.keyboard.press('Space');
    await page.waitForFunction(() => window.meshtween.then((m) => m.u() < 0.9));
    await page.keyboard.press('Space');
    const stopped = await u();
    await page.waitForTimeout(150);
    assert.equal(await u(), stopped, 'the pause does not hold');
    await page.keyboard.press('w');
    assert.equal(await page.getAttribute('#wire', 'aria-pressed'), 'true');
    await page.keyboard.press('l');
    assert.equal(await page.getAttribute('#mode', 'aria-pressed'), 'false');
    const visited = new Set();
    for (let i = 0; i < 8; ++i) {
        await page.keyboard.press('Tab');
        visited.add(await page.evaluate(() => document.activeElement?.id ?? ''));
    }
    for (const id of ['view', 'play', 'u', 'mode', 'speed', 'wire', 'reset']) assert.ok(visited.has(id), `Tab misses ${id}`);
    await drawn(page);
    await page.screenshot({ path: join(folder, 'wireframe.png') });
    await page.keyboard.press('w');
}

// Nothing may stick out of a narrow window, and nothing of the bar may be hidden.
async function checkSizes(page) {
    await page.evaluate(() => window.meshtween.then((m) => m.setU(0.75)));
    for (const [width, height, colorScheme] of [[1280, 720, 'light'], [1920, 400, 'light'], [360, 640, 'dark']]) {
        await page.setViewportSize({ width, height });
        await page.emulateMedia({ colorScheme });
        for (const id of ['play', 'u', 'value', 'mode', 'speed', 'wire', 'reset']) {
            const box = await page.locator(`#${id}`).boundingBox();
            assert.ok(box && box.x >= 0 && box.y >= 0 && box.x + box.width <= width && box.y + box.height <= height,
                `${id} is cut off at ${width} x ${height}`);
        }
        await drawn(page);
        await page.screenshot({ path: join(folder, `player_${width}_${colorScheme}.png`) });
    }
}

// Opens a page, runs the checks on it, and sees that it was silent and loaded nothing.
async function checked(name, checks) {
    const { page, complaints, foreign } = await opened(`${name}.html`);
    await checks(page);
    assert.deepEqual(foreign(), []);
    assert.deepEqual(complaints, []);
    await page.close();
}

// Textures are there, and parts of several materials are one mesh whose vertices seams do not repeat.
async function checkTextures(page, name, textures) {
    const shown = await page.evaluate(() => window.meshtween.then((m) => {
        m.setU(0.5);
        return { textures: m.textures(), vertices: m.vertexCount, triangles: m.triangleCount, all: m.vertices().every(Number.isFinite) };
    }));
    assert.deepEqual(shown, { textures, vertices: 1090, triangles: 2176, all: true });
    await drawn(page);
    await page.screenshot({ path: join(folder, `${name}.png`) });
}

try {
    await checked('morph', async (page) => {
        await checkKeys(page);
        await checkShapes(page, 'morph', 1e-6);
        await checkSizes(page);
    });
    await checked('path', (page) => checkShapes(page, 'path', 1e-4)); // the tolerance of curves
    await checked('keys', (page) => checkShapes(page, 'keys', 1e-6));
    await checked('far', (page) => checkShapes(page, 'far', 1e-6));
    await checked('sample_morph', (page) => checkTextures(page, 'sample_morph', 1));
    await checked('materials', (page) => checkTextures(page, 'materials', 1));
} finally {
    await browser.close();
}
