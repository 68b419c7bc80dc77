// What three.js shows of the files of played_files.py: three.mjs FOLDER. Its loader and its animation mixer, as any page
// uses them, without a picture.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { AnimationMixer, LoopOnce, Vector3 } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

const folder = process.argv[2];
globalThis.self ??= globalThis; // the loader asks for it

function diagonalOf(vertices) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    vertices.forEach((x, i) => {
        low[i % 3] = Math.min(low[i % 3], x);
        high[i % 3] = Math.max(high[i % 3], x);
    });
    return Math.hypot(...high.map((x, c) => x - low[c]));
}

function checkWeights(name, { values }, count) {
    for (let row = 0; row < values.length; row += count) {
        const weights = Array.from(values.subarray(row, row + count));
        assert.ok(weights.every((w) => w >= 0 && w <= 1), `${name}: a weight outside 0..1 in ${weights}`);
        assert.ok(weights.reduce((a, b) => a + b, 0) <= 1, `${name}: weights of more than 1 in ${weights}`);
    }
}

const names = readdirSync(folder).filter((file) => file.endsWith('.glb')).map((file) => file.slice(0, -4));
assert.ok(names.length >= 4, `no files in ${folder}`);
for (const name of names) {
    const bytes = readFileSync(join(folder, `${name}.glb`));
    const { scene, animations } = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
    let mesh;
    scene.traverse((object) => object.isMesh && (mesh ??= object));
    checkWeights(name, animations[0].tracks[0], mesh.morphTargetInfluences.length);
    const mixer = new AnimationMixer(scene);
    const action = mixer.clipAction(animations[0]);
    action.setLoop(LoopOnce).play();
    const { seconds, tolerance, moments } = JSON.parse(readFileSync(join(folder, `${name}.json`), 'utf8'));
    const diagonal = diagonalOf(moments[0].vertices);
    const point = new Vector3();
    for (const { t, vertices } of moments) {
        mixer.setTime(t * seconds);
        scene.updateMatrixWorld(true);
        let worst = 0;
        for (let i = 0; i < vertices.length / 3; ++i) {
            mesh.getVertexPosition(i, point).applyMatrix4(mesh.matrixWorld);
            worst = Math.max(worst, Math.hypot(point.x - vertices[3 * i], point.y - vertices[3 * i + 1], point.z - vertices[3 * i + 2]));
        }
        console.log(`${name} at ${t}: ${(worst / diagonal).toExponential(1)} of the diagonal`);
        assert.ok(worst / diagonal <= tolerance, `${name} at ${t} is ${worst / diagonal} of the diagonal off in three.js`);
    }
}
