// B-splines on a row of knots (de Boor's recursion): what the library's SplineBasis::weights computes, in the same steps.
export function spline(degree: number, knots: readonly number[]): (u: number) => number[] {
    const count = knots.length - degree - 1;
    return (parameter) => {
        const u = Math.min(Math.max(parameter, knots[0]!), knots[knots.length - 1]!);
        // The last span that begins at or before u and is not empty.
        let i = degree;
        while (i + 1 < count && knots[i + 1]! <= u) ++i;
        const weights = new Array<number>(count).fill(0);
        const first = i - degree; // the weights of this span begin here
        weights[first] = 1;
        for (let d = 1; d <= degree; ++d) {
            let given = 0; // by the weight before
            for (let k = 0; k < d; ++k) {
                const left = knots[i + 1 - d + k]!, right = knots[i + 1 + k]!, own = weights[first + k]!;
                const passed = ((u - left) / (right - left)) * own;
                weights[first + k] = given + ((right - u) / (right - left)) * own;
                given = passed;
            }
            weights[first + d] = given;
        }
        for (let k = first; k <= i; ++k) weights[k] = Math.min(weights[k]!, 1); // rounding may pass it
        return weights;
    };
}
