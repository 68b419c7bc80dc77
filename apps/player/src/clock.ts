// Where a playing morph stands: pure functions, so that time is nobody's business but the caller's.
import { eased, timeOf, type Ease } from './ease';

export interface Clock {
    u: number; // 0..1
    forward: boolean; // the direction when playing back and forth
    playing: boolean;
    pingPong: boolean;
    speed: number; // 1: as the file says
    seconds: number; // from one end to the other at speed 1
    ease: Ease;
}

export function advanced(clock: Clock, elapsed: number): Clock {
    if (!clock.playing || !(clock.seconds > 0)) return clock;
    const step = (elapsed * clock.speed) / clock.seconds;
    const time = timeOf(clock.ease, clock.u);
    if (!clock.pingPong) return { ...clock, u: eased(clock.ease, (time + step) % 1), forward: true };
    // Back and forth is a circle of circumference 2: up over 0..1, down over 1..2.
    const phase = ((clock.forward ? time : 2 - time) + step) % 2;
    return { ...clock, u: eased(clock.ease, phase <= 1 ? phase : 2 - phase), forward: phase <= 1 };
}
