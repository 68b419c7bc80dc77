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

// The same where one polynomial follows the other: `knots` are the nodes at which pieces begin and end.
export function piecewise(parameters: readonly number[], knots: readonly number[]): (u: number) => number[] {
    const pieces = knots.slice(1).map((last, p) => ({
        first: knots[p]!,
        end: parameters[last]!,
        weights: lagrange(parameters.slice(knots[p], last + 1)),
    }));
    return (u) => {
        const piece = pieces.find(({ end }) => u <= end) ?? pieces[pieces.length - 1]!;
        const all = parameters.map(() => 0);
        piece.weights(u).forEach((weight, k) => (all[piece.first + k] = weight));
        return all;
    };
}
