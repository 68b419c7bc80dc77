// The player of an exported page: the model and the options stand in the page itself, nothing is fetched.
import './style.css';
import type { MeshStandardMaterial } from 'three';
import { advanced, type Clock } from './clock';
import type { Ease } from './ease';
import { bytesOf, loadModel, type Model } from './model';
import { makeStage, type Stage } from './stage';

interface Options {
    seconds: number;
    pingPong: boolean;
    ease: Ease;
}

// For tests: `await window.meshtween` gives what the page shows.
export interface Hook {
    setU(u: number): void; // pauses
    u(): number;
    weights(u: number): number[]; // of the base and all targets
    vertices(): Float64Array; // x, y, z each
    vertexCount: number;
    triangleCount: number;
    textures(): number; // parts of the model that show one
}
declare global {
    interface Window {
        meshtween: Promise<Hook>;
    }
}

function element<T extends HTMLElement>(id: string, kind: new () => T): T {
    const found = document.getElementById(id);
    if (!(found instanceof kind)) throw new Error(`the page has no ${id}`);
    return found;
}

function textOf(id: string): string {
    return document.getElementById(id)?.textContent ?? '';
}

const slider = element('u', HTMLInputElement);
const value = element('value', HTMLOutputElement);
const play = element('play', HTMLButtonElement);
const mode = element('mode', HTMLButtonElement);
const wire = element('wire', HTMLButtonElement);
const speed = element('speed', HTMLSelectElement);

function run(model: Model, stage: Stage, options: Options): Hook {
    let clock: Clock = {
        u: 0,
        forward: true,
        playing: false,
        pingPong: options.pingPong,
        speed: 1,
        seconds: options.seconds,
        ease: options.ease,
    };
    let last = 0;

    const show = () => {
        model.setU(clock.u);
        slider.value = String(clock.u);
        slider.style.setProperty('--u', String(clock.u));
        value.textContent = clock.u.toFixed(3);
        play.setAttribute('aria-label', clock.playing ? 'Pause' : 'Play');
        document.body.classList.toggle('playing', clock.playing);
        mode.setAttribute('aria-pressed', String(clock.pingPong));
        stage.redraw();
    };
    const tick = (now: number) => {
        if (!clock.playing) return;
        clock = advanced(clock, Math.min(0.1, (now - last) / 1000));
        last = now;
        show();
        requestAnimationFrame(tick);
    };
    const set = (change: Partial<Clock>) => {
        const starts = change.playing === true && !clock.playing;
        clock = { ...clock, ...change };
        show();
        if (!starts) return;
        last = performance.now();
        requestAnimationFrame(tick);
    };
    const toggleWire = () => {
        const on = wire.getAttribute('aria-pressed') !== 'true';
        wire.setAttribute('aria-pressed', String(on));
        stage.setWireframe(on);
    };
    const move = (step: number) => set({ playing: false, u: Math.min(1, Math.max(0, clock.u + step)) });

    slider.addEventListener('input', () => set({ playing: false, u: Number(slider.value) }));
    play.addEventListener('click', () => set({ playing: !clock.playing }));
    mode.addEventListener('click', () => set({ pingPong: !clock.pingPong, forward: true }));
    speed.addEventListener('change', () => set({ speed: Number(speed.value) }));
    wire.addEventListener('click', toggleWire);
    element('reset', HTMLButtonElement).addEventListener('click', () => stage.resetView());

    const keys: Record<string, () => void> = {
        ' ': () => set({ playing: !clock.playing }),
        ArrowLeft: () => move(-0.01),
        ArrowRight: () => move(0.01),
        Home: () => move(-1),
        End: () => move(1),
        l: () => set({ pingPong: !clock.pingPong, forward: true }),
        w: toggleWire,
        r: () => stage.resetView(),
    };
    document.addEventListener('keydown', (event) => {
        const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
        const own = event.target instanceof HTMLButtonElement && event.key === ' '; // a button presses itself
        const fields = event.target instanceof HTMLSelectElement || (event.target === slider && event.key !== ' ' && event.key.length > 1);
        if (!action || own || fields || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        action();
    });

    show();
    if (model.meshes[0]?.morphTargetInfluences && !matchMedia('(prefers-reduced-motion: reduce)').matches) set({ playing: true });
    return {
        setU: (u) => set({ playing: false, u }),
        u: () => clock.u,
        weights: (u) => model.weights(u),
        vertices: () => model.vertices(),
        vertexCount: model.vertexCount,
        triangleCount: model.triangleCount,
        textures: () => model.meshes.filter(({ material }) => (material as MeshStandardMaterial).map?.image).length,
    };
}

async function start(): Promise<Hook> {
    const options = JSON.parse(textOf('options')) as Options;
    const model = await loadModel(bytesOf(textOf('model')));
    document.getElementById('model')?.remove(); // its text is no longer needed
    const number = new Intl.NumberFormat('en-GB');
    element('counts', HTMLParagraphElement).textContent =
        `${number.format(model.vertexCount)} vertices \u00b7 ${number.format(model.triangleCount)} triangles`;
    const stage = makeStage(element('view', HTMLCanvasElement), element('controls', HTMLElement), model);
    return run(model, stage, options);
}

window.meshtween = start();
window.meshtween.catch((error: unknown) => {
    const message = element('message', HTMLParagraphElement);
    message.textContent = `This page cannot show its shape: ${error instanceof Error ? error.message : String(error)}`;
    message.hidden = false;
});
