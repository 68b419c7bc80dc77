// The page's GLB: its shapes, and the mesh that shows one of those between them.
import { Box3, Matrix4, Mesh, Vector3, type BufferAttribute, type Group } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { lagrange, piecewise } from './lagrange';

export interface Model {
    scene: Group;
    mesh: Mesh;
    box: Box3; // holds all shapes, in the scene's coordinates
    outline: Float32Array; // x, y, z of some thousand points of all shapes: what a view should hold
    vertexCount: number;
    triangleCount: number;
    setU(u: number): void;
    vertices(): Float64Array; // x, y, z a vertex as three.js blends them now, in the file's coordinates
}

export function bytesOf(base64: string): ArrayBuffer {
    const text = atob(base64.trim());
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes.buffer;
}

export async function loadModel(glb: ArrayBuffer): Promise<Model> {
    const { scene } = await new GLTFLoader().parseAsync(glb, '');
    scene.updateMatrixWorld(true);
    let found: Mesh | undefined;
    scene.traverse((object) => {
        if (object instanceof Mesh) found ??= object;
    });
    if (!found) throw new Error('the file holds no mesh');
    const mesh = found;
    mesh.frustumCulled = false; // its bounds are those of the first shape only
    mesh.castShadow = mesh.receiveShadow = true;

    const toScene = mesh.matrixWorld.clone();
    const parameters = (mesh.userData['parameters'] as number[] | undefined) ?? [0];
    const knots = mesh.userData['knots'] as number[] | undefined;
    const weights = knots ? piecewise(parameters, knots) : lagrange(parameters);
    const influences = mesh.morphTargetInfluences ?? [];
    if (influences.length !== parameters.length - 1) throw new Error('the file does not say where its shapes lie');
    return {
        scene,
        mesh,
        ...extentOf(mesh, toScene),
        vertexCount: mesh.geometry.getAttribute('position').count,
        triangleCount: (mesh.geometry.index?.count ?? 0) / 3,
        // The base's weight is what the targets' leave of 1: its own.
        setU: (u) => weights(u).slice(1).forEach((weight, k) => (influences[k] = weight)),
        vertices: () => verticesOf(mesh, toScene),
    };
}

function verticesOf(mesh: Mesh, toScene: Matrix4): Float64Array {
    const count = mesh.geometry.getAttribute('position').count;
    const result = new Float64Array(3 * count);
    const point = new Vector3();
    for (let i = 0; i < count; ++i) mesh.getVertexPosition(i, point).applyMatrix4(toScene).toArray(result, 3 * i);
    return result;
}

// The box around all shapes, and points of them. One target at a time is exact: they are the path's own shapes.
function extentOf(mesh: Mesh, toScene: Matrix4): Pick<Model, 'box' | 'outline'> {
    const base = mesh.geometry.getAttribute('position');
    const targets = (mesh.geometry.morphAttributes['position'] ?? []) as BufferAttribute[];
    const stride = Math.ceil((base.count * (targets.length + 1)) / 20000);
    const box = new Box3();
    const outline: number[] = [];
    const point = new Vector3(), offset = new Vector3();
    let seen = 0;
    const add = () => {
        box.expandByPoint(point.applyMatrix4(toScene));
        if (seen++ % stride === 0) outline.push(point.x, point.y, point.z);
    };
    for (let i = 0; i < base.count; ++i) {
        point.fromBufferAttribute(base, i);
        add();
        for (const target of targets) {
            point.fromBufferAttribute(base, i).add(offset.fromBufferAttribute(target, i));
            add();
        }
    }
    return { box, outline: new Float32Array(outline) };
}
