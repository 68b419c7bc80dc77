// Camera, light and ground around a model, drawn only when something changed.
import {
    CircleGeometry, DirectionalLight, Group, HemisphereLight, Mesh, MeshBasicMaterial, MeshStandardMaterial,
    NeutralToneMapping, PerspectiveCamera, PMREMGenerator, Scene, ShadowMaterial, Spherical, Vector3, VSMShadowMap, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { RoomEnvironment } from 'three/examples/jsm/environments/RoomEnvironment.js';
import type { Model } from './model';

export interface Stage {
    redraw(): void; // at the next frame
    resetView(): void;
    setWireframe(on: boolean): void;
}

const azimuth = 25, elevation = 10; // degrees, as on the contact sheets

export function makeStage(canvas: HTMLCanvasElement, bar: HTMLElement, model: Model): Stage {
    const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    renderer.toneMapping = NeutralToneMapping;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = VSMShadowMap; // the one that can be wide and smooth
    const scene = new Scene();

    // One unit of the stage is the model's radius: light, shadows and steps of the camera need no other scale.
    const size = model.box.getSize(new Vector3()), centre = model.box.getCenter(new Vector3());
    const scale = 2 / Math.max(size.length(), 1e-30);
    const root = new Group();
    root.scale.setScalar(scale);
    root.position.copy(centre).multiplyScalar(-scale);
    root.add(model.scene);
    const wires = model.meshes.map(wireframeOf);
    dress(model.meshes, renderer, scene);
    scene.add(root);
    const ground = addGround(scene, (-size.y * scale) / 2);
    const outline = pointsOf(model.outline).map((p) => p.sub(centre).multiplyScalar(scale));
    addLights(scene);

    const camera = new PerspectiveCamera(28, 1, 0.01, 100);
    const fill = new DirectionalLight(0xeef2fb, 0.55); // comes along with the viewer: no side stays black
    fill.position.set(0.5, 0.3, 1);
    camera.add(fill, fill.target);
    scene.add(camera);
    const controls = new OrbitControls(camera, canvas);
    controls.enableDamping = !matchMedia('(prefers-reduced-motion: reduce)').matches;
    controls.dampingFactor = 0.12;
    controls.minDistance = 0.2;
    controls.maxDistance = 30;

    let pending = false;
    const redraw = () => {
        if (pending) return;
        pending = true;
        requestAnimationFrame(draw);
    };
    const draw = () => {
        pending = false;
        if (controls.update()) redraw(); // still gliding
        renderer.render(scene, camera);
    };
    const resetView = () => {
        controls.target.set(0, 0, 0);
        camera.position.copy(viewpoint(camera, outline, bar.offsetHeight / Math.max(1, canvas.clientHeight)));
        controls.update();
        redraw();
    };
    const resize = () => {
        const { clientWidth: width, clientHeight: height } = canvas;
        renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        renderer.setSize(width, height, false);
        camera.aspect = width / Math.max(1, height);
        // The middle of what the bar leaves free is the middle of the picture.
        camera.setViewOffset(width, height, 0, bar.offsetHeight / 2, width, height);
        camera.updateProjectionMatrix();
        if (!touched) resetView();
        redraw();
    };
    let touched = false;
    controls.addEventListener('start', () => (touched = true));
    controls.addEventListener('change', redraw);
    turnByKeys(canvas, camera, controls, () => {
        touched = true;
        redraw();
    });
    new ResizeObserver(resize).observe(canvas);
    followColorScheme(ground, redraw);
    return {
        redraw,
        resetView: () => {
            touched = false;
            resetView();
        },
        setWireframe: (on) => {
            for (const wire of wires) wire.visible = on;
            redraw();
        },
    };
}

function pointsOf(coordinates: Float32Array): Vector3[] {
    return Array.from({ length: coordinates.length / 3 }, (_, i) => new Vector3().fromArray(coordinates, 3 * i));
}

// From where all points are seen, whatever the window's shape. `covered`: the part of its height under the bar.
function viewpoint(camera: PerspectiveCamera, points: Vector3[], covered: number): Vector3 {
    const towards = new Vector3().setFromSphericalCoords(1, ((90 - elevation) * Math.PI) / 180, (azimuth * Math.PI) / 180);
    const right = new Vector3(0, 1, 0).cross(towards).normalize(), up = towards.clone().cross(right);
    const half = Math.tan((camera.fov * Math.PI) / 360);
    const tall = half * Math.max(0.3, 0.86 - covered), wide = half * camera.aspect * 0.84; // margins
    let distance = 0.5;
    for (const p of points) {
        const out = Math.max(Math.abs(p.dot(right)) / wide, Math.abs(p.dot(up)) / tall);
        distance = Math.max(distance, p.dot(towards) + out);
    }
    return towards.multiplyScalar(distance);
}

function addLights(scene: Scene): void {
    scene.add(new HemisphereLight(0xe6edf7, 0xb9aea2, 1.15));
    const key = shadowLight(2.0, 1024, 9);
    key.color.set(0xfff6ea);
    key.position.set(-2.4, 4.1, 2.6);
    const above = shadowLight(0.35, 256, 10); // its coarse map is the soft dark under the shape
    above.position.set(0, 5, 0.01);
    const rim = new DirectionalLight(0xdfe9ff, 0.9);
    rim.position.set(2.6, 1.6, -3);
    scene.add(key, above, rim);
}

function shadowLight(intensity: number, side: number, blur: number): DirectionalLight {
    const light = new DirectionalLight(0xffffff, intensity);
    light.castShadow = true;
    light.shadow.mapSize.set(side, side);
    light.shadow.radius = blur;
    light.shadow.blurSamples = 12;
    light.shadow.normalBias = 3 / side;
    light.shadow.bias = -0.0006;
    const { camera } = light.shadow;
    camera.left = camera.bottom = -1.5;
    camera.right = camera.top = 1.5;
    camera.near = 2;
    camera.far = 9;
    return light;
}

function addGround(scene: Scene, height: number): ShadowMaterial {
    const material = new ShadowMaterial({ opacity: 0.2 });
    const ground = new Mesh(new CircleGeometry(12, 48), material);
    ground.rotation.x = -Math.PI / 2;
    ground.position.y = height - 0.002;
    ground.receiveShadow = true;
    scene.add(ground);
    return material;
}

// Textures stay sharp at a slant, and metal, which is black without a room around it, gets one.
function dress(meshes: Mesh[], renderer: WebGLRenderer, scene: Scene): void {
    const materials = meshes.map((mesh) => mesh.material).filter((material) => material instanceof MeshStandardMaterial);
    for (const { map } of materials) if (map) map.anisotropy = renderer.capabilities.getMaxAnisotropy();
    if (!materials.some((material) => material.metalness > 0.05)) return;
    const maker = new PMREMGenerator(renderer);
    scene.environment = maker.fromScene(new RoomEnvironment(), 0.04).texture;
    scene.environmentIntensity = 0.6;
    maker.dispose();
}

// The same mesh once more, as lines a little in front of the surface.
function wireframeOf(mesh: Mesh): Mesh {
    const material = new MeshBasicMaterial({
        color: 0x1b1f24, wireframe: true, transparent: true, opacity: 0.28, depthWrite: false,
        polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1,
    });
    const wire = new Mesh(mesh.geometry, material);
    if (mesh.morphTargetInfluences) wire.morphTargetInfluences = mesh.morphTargetInfluences; // shared: moves alike
    wire.frustumCulled = false;
    wire.visible = false;
    mesh.add(wire);
    return wire;
}

function turnByKeys(canvas: HTMLCanvasElement, camera: PerspectiveCamera, controls: OrbitControls, moved: () => void): void {
    const steps: Record<string, [number, number, number]> = {
        ArrowLeft: [-1, 0, 1], ArrowRight: [1, 0, 1], ArrowUp: [0, -1, 1], ArrowDown: [0, 1, 1],
        '+': [0, 0, 1 / 1.1], '=': [0, 0, 1 / 1.1], '-': [0, 0, 1.1],
    };
    canvas.addEventListener('keydown', (event) => {
        const step = steps[event.key];
        if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        event.stopPropagation();
        const place = new Spherical().setFromVector3(camera.position.clone().sub(controls.target));
        place.theta += step[0] * 0.1;
        place.phi += step[1] * 0.1;
        place.radius = Math.min(controls.maxDistance, Math.max(controls.minDistance, place.radius * step[2]));
        camera.position.setFromSpherical(place.makeSafe()).add(controls.target);
        moved();
    });
}

function followColorScheme(ground: ShadowMaterial, redraw: () => void): void {
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const apply = () => {
        ground.opacity = dark.matches ? 0.5 : 0.17;
        redraw();
    };
    dark.addEventListener('change', apply);
    apply();
}
