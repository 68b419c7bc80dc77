// Slow at the start, at the end or at both: what the library's ease() computes, and the time at which it gets somewhere.
export type Ease = 'linear' | 'in' | 'out' | 'in-out';

export function eased(kind: Ease, t: number): number {
    switch (kind) {
        case 'in': return t * t;
        case 'out': return t * (2 - t);
        case 'in-out': return t * t * (3 - 2 * t);
        default: return t;
    }
}

export function timeOf(kind: Ease, u: number): number {
    switch (kind) {
        case 'in': return Math.sqrt(u);
        case 'out': return 1 - Math.sqrt(1 - u);
        case 'in-out': return 0.5 - Math.sin(Math.asin(1 - 2 * u) / 3);
        default: return u;
    }
}
