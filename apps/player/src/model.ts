// The page's GLB: its shapes, and the meshes (one a material) that show one of those between them.
import { Box3, Matrix4, Mesh, Vector3, type BufferAttribute, type Group, type Material } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { spline } from './spline';

export interface Model {
    scene: Group;
    meshes: Mesh[];
    box: Box3; // holds all shapes, in the scene's coordinates
    outline: Float32Array; // x, y, z of some thousand points of all shapes: what a view should hold
    vertexCount: number;
    triangleCount: number;
    weights(u: number): number[]; // of the base and all targets
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
    const meshes: Mesh[] = [];
    const covers: Mesh[] = []; // of a second look, which lies over the first as it fades in
    scene.traverse((object) => {
        if (!(object instanceof Mesh)) return;
        const covering = object.userData['cover'] ?? object.parent?.userData['cover']; // the node is the mesh, or holds its parts
        (covering ? covers : meshes).push(object);
    });
    const mesh = meshes[0];
    if (!mesh) throw new Error('the file holds no mesh');
    for (const part of meshes) {
        part.frustumCulled = false; // its bounds are those of the first shape only
        part.castShadow = part.receiveShadow = true;
        if (mesh.morphTargetInfluences) part.morphTargetInfluences = mesh.morphTargetInfluences; // shared: moves alike
    }

    for (const cover of covers) layOver(mesh, cover);

    const toScene = mesh.matrixWorld.clone();
    const degree = (mesh.userData['degree'] as number | undefined) ?? 0;
    const knots = (mesh.userData['knots'] as number[] | undefined) ?? [0, 1]; // a mesh alone
    const weights = spline(degree, knots);
    const influences = mesh.morphTargetInfluences ?? [];
    if (influences.length !== knots.length - degree - 2) throw new Error('the file does not say how its shapes are blended');
    return {
        scene,
        meshes,
        ...extentOf(meshes, toScene, weights),
        vertexCount: numberingOf(meshes).count,
        triangleCount: meshes.reduce((sum, part) => sum + (part.geometry.index?.count ?? 0) / 3, 0),
        weights,
        // The base's weight is what the targets' leave of 1: its own.
        setU: (u) => weights(u).slice(1).forEach((weight, k) => (influences[k] = weight)),
        vertices: () => verticesOf(meshes, toScene),
    };
}

// Moves as the mesh does, and is drawn a little in front of it.
function layOver(mesh: Mesh, cover: Mesh): void {
    if (mesh.morphTargetInfluences) cover.morphTargetInfluences = mesh.morphTargetInfluences;
    cover.frustumCulled = false;
    cover.receiveShadow = true;
    const material = cover.material as Material;
    material.polygonOffset = true;
    material.polygonOffsetFactor = material.polygonOffsetUnits = -1;
}

// Which vertex of the model each of a mesh's is: the file tells where seams or materials repeat some.
function numberingOf(meshes: Mesh[]): { count: number; vertex(part: number, i: number): number } {
    const told = meshes.map((mesh) => mesh.geometry.attributes['_vertex']); // three.js keeps such names in small letters
    let count = 0;
    const firsts = meshes.map((mesh, part) => {
        const first = count, numbers = told[part], size = mesh.geometry.getAttribute('position').count;
        if (!numbers) count += size;
        else for (let i = 0; i < size; ++i) count = Math.max(count, numbers.getX(i) + 1);
        return first;
    });
    return { count, vertex: (part, i) => told[part]?.getX(i) ?? firsts[part]! + i };
}

function verticesOf(meshes: Mesh[], toScene: Matrix4): Float64Array {
    const { count, vertex } = numberingOf(meshes);
    const result = new Float64Array(3 * count);
    const point = new Vector3();
    meshes.forEach((mesh, part) => {
        for (let i = 0; i < mesh.geometry.getAttribute('position').count; ++i)
            mesh.getVertexPosition(i, point).applyMatrix4(toScene).toArray(result, 3 * vertex(part, i));
    });
    return result;
}

// Which vertices faces have: others may lie anywhere. Null where all do.
function usedIn(mesh: Mesh): Uint8Array | null {
    const index = mesh.geometry.index;
    if (!index) return null;
    const used = new Uint8Array(mesh.geometry.getAttribute('position').count);
    for (let k = 0; k < index.count; ++k) used[index.getX(k)] = 1;
    return used;
}

// The box around shapes all along the path, and points of them. The targets themselves lie beside it.
function extentOf(meshes: Mesh[], toScene: Matrix4, weights: (u: number) => number[]): Pick<Model, 'box' | 'outline'> {
    const total = meshes.reduce((sum, mesh) => sum + mesh.geometry.getAttribute('position').count, 0);
    const moves = meshes.some((mesh) => mesh.geometry.morphAttributes['position']?.length);
    const looks = !moves ? 1 : total > 300_000 ? 9 : 17;
    const stride = Math.ceil((total * looks) / 20000);
    const box = new Box3();
    const outline: number[] = [];
    const point = new Vector3(), offset = new Vector3();
    const faces = meshes.map(usedIn);
    let seen = 0;
    for (let look = 0; look < looks; ++look) {
        const shares = weights(look / Math.max(1, looks - 1)).slice(1);
        for (const [part, mesh] of meshes.entries()) {
            const base = mesh.geometry.getAttribute('position');
            const targets = (mesh.geometry.morphAttributes['position'] ?? []) as BufferAttribute[];
            const parts = targets.flatMap((target, k) => (shares[k]! > 0 ? [{ target, share: shares[k]! }] : []));
            for (let i = 0; i < base.count; ++i) {
                if (faces[part] && !faces[part][i]) continue;
                point.fromBufferAttribute(base, i);
                for (const { target, share } of parts) point.addScaledVector(offset.fromBufferAttribute(target, i), share);
                box.expandByPoint(point.applyMatrix4(toScene));
                if (seen++ % stride === 0) outline.push(point.x, point.y, point.z);
            }
        }
    }
    return { box, outline: new Float32Array(outline) };
}
