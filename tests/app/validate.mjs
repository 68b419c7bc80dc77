// The Khronos validator over every glTF of a folder: no error, no warning. validate.mjs FOLDER
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { validateBytes, version } from 'gltf-validator';

const folder = process.argv[2];
const names = readdirSync(folder).filter((name) => /\.(glb|gltf)$/.test(name));
if (names.length === 0) throw new Error(`no glTF in ${folder}`);
const beside = (uri) => Promise.resolve(new Uint8Array(readFileSync(join(folder, decodeURIComponent(uri)))));
console.log(`glTF validator ${version()}`);
let failed = false;
for (const name of names) {
    const { issues, info } = await validateBytes(new Uint8Array(readFileSync(join(folder, name))), {
        maxIssues: 20,
        externalResourceFunction: beside,
    });
    console.log(`${name}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos; `
        + `${info.totalVertexCount} vertices, ${info.totalTriangleCount} triangles`);
    for (const { code, message, pointer } of issues.messages) console.log(`  ${code} ${pointer}: ${message}`);
    failed ||= issues.numErrors > 0 || issues.numWarnings > 0;
}
process.exitCode = failed ? 1 : 0;
