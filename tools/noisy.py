"""Markers as people place them: beside the true ones, each target's moved by a normal error of 1 % of the diagonal in
each coordinate, and each lifted 2 % off the surface. Scored is how far the vertices end from where they belong."""
import os
import random
import sys

from cases import fit, rows_of
from partial import read_obj, truth_within

NOISE, FLOATING = 0.01, 0.02  # of the target's diagonal


def lifted(place, points, faces, height):
    """The place, moved off the surface along the normal of its nearest vertex."""
    distance = lambda i: sum((a - b) ** 2 for a, b in zip(points[i], place))
    nearest = min(range(len(points)), key=distance)
    normal = [0.0, 0.0, 0.0]
    for face in faces:
        if nearest not in face:
            continue
        a, b, c = (points[i] for i in face[:3])
        u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        for k in range(3):
            normal[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]
    length = sum(n * n for n in normal) ** .5
    return [p + height * n / length for p, n in zip(place, normal)]


def noisy_table(program, cases, folder, extra=()):
    lines = ["| case | markers | truth | times exact | markers' error | flips | cuts | seconds |", "|---|" + "---|" * 7]
    everywhere = lambda place: True
    for case in cases:
        truth_file = os.path.join(case, "truth.csv")
        if not os.path.exists(truth_file):
            continue
        source, target = os.path.join(case, "source.obj"), os.path.join(case, "target.obj")
        points, faces = read_obj(target)
        low, high = ([f(p[k] for p in points) for k in range(3)] for f in (min, max))
        size = sum((a - b) ** 2 for a, b in zip(low, high)) ** .5
        truth = [[float(x) for x in r] for r in rows_of(truth_file)[1:]]
        markers = rows_of(os.path.join(case, "markers.csv"))[1:]
        places = [[float(x) for x in r[4:7]] for r in markers]
        chance = random.Random(1)
        kinds = {"exact": places,
                 "1 % noise": [[x + chance.gauss(0, NOISE * size) for x in p] for p in places],
                 "2 % floating": [lifted(p, points, faces, FLOATING * size) for p in places]}
        exact = None
        for kind, moved in kinds.items():
            done = fit(program, source, target, [r[:4] + p for r, p in zip(markers, moved)], folder, extra)
            name = os.path.basename(case)
            if isinstance(done, str):
                lines.append("| %s | %s | failed: %s |" % (name, kind, done))
                continue
            error = truth_within(folder, truth, everywhere, size)
            exact = exact or error
            q = done["quality"]
            lines.append("| %s | %s | %.3f | %.2f | %.3f | %d | %d | %.1f |" % (
                name, kind, error, error / exact, q["marker_error"]["mean"], done["guards"]["flips_left"],
                q["self_intersections"], done["seconds"]))
            print(lines[-1], file=sys.stderr, flush=True)
    return lines
