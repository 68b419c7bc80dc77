// The weights of the polynomial through values at the nodes `parameters` (Berrut and Trefethen 2004, Barycentric Lagrange
// interpolation, Eq. 4.2): what the library's Curve::weights computes.
export function lagrange(parameters: readonly number[]): (u: number) => number[] {
    // Four times the distance: products of 33 nodes of [0, 1] neither vanish nor overflow.
    const scale = parameters.map((x, j) =>
        parameters.reduce((product, y, k) => (k === j ? product : product / (4 * (x - y))), 1));
    return (u) => {
        const at = parameters.indexOf(u);
        if (at >= 0) return parameters.map((_, k) => (k === at ? 1 : 0));
        const terms = parameters.map((x, k) => scale[k]! / (u - x));
        const sum = terms.reduce((a, b) => a + b, 0);
        return terms.map((term) => term / sum);
    };
}
