"""Targets of which only a part is there: of each case's target three fifths, cut off along each of its axes.

What lies beyond the cut has no counterpart. Scored are the vertices whose true place is on the part that is left, and
the same vertices of the fit to the whole target beside them.
"""
import os
import sys

from cases import fit, rows_of

KEPT = 0.6  # of the vertices
LEAST_MARKERS = 4


def read_obj(path):
    points, faces = [], []
    with open(path) as f:
        for line in f:
            words = line.split()
            if line.startswith("v "):
                points.append([float(w) for w in words[1:4]])
            elif line.startswith("f "):
                faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return points, faces


def write_obj(path, points, faces):
    number = {}
    for face in faces:
        for i in face:
            number.setdefault(i, len(number) + 1)
    with open(path, "w") as f:
        f.writelines("v %.9g %.9g %.9g\n" % tuple(points[i]) for i in number)
        f.writelines("f %s\n" % " ".join(str(number[i]) for i in face) for face in faces)


def largest_piece(faces):
    parent = {}

    def root(i):
        while parent.setdefault(i, i) != i:
            parent[i] = i = parent[parent[i]]
        return i

    for face in faces:
        for i in face[1:]:
            parent[root(i)] = root(face[0])
    count = {}
    for face in faces:
        count[root(face[0])] = count.get(root(face[0]), 0) + 1
    largest = max(count, key=count.get)
    return [face for face in faces if root(face[0]) == largest]


def truth_within(folder, truth, inside, size):
    """Mean error of the vertices whose true place is on the part, in percent of the whole target's diagonal."""
    found, _ = read_obj(os.path.join(folder, "fitted.obj"))
    errors = [sum((a - b) ** 2 for a, b in zip(p, t)) ** .5 for p, t in zip(found, truth) if inside(t)]
    return 100 * sum(errors) / len(errors) / size


def row_of(name, part, score):
    if isinstance(part, str):
        return "| %s | failed: %s |" % (name, part)
    q = part["quality"]
    return "| %s | %d | %s | %.3f | %.3f | %d | %d (%d + %d) | %.1f |" % (
        name, part["beyond"]["vertices"], score, q["target_to_fitted"]["mean"], q["marker_error"]["mean"],
        part["guards"]["flips_left"], q["self_intersections"], q["self_intersections_source"], q["self_intersections_target"],
        part["seconds"])


def partial_table(program, cases, folder):
    lines = ["| case, kept | beyond | truth: part / whole | back | markers | flips | cuts (source + target) | seconds |",
             "|---|" + "---|" * 7]
    for case in cases:
        source, target = os.path.join(case, "source.obj"), os.path.join(case, "target.obj")
        points, faces = read_obj(target)
        low, high = ([f(p[k] for p in points) for k in range(3)] for f in (min, max))
        size = sum((a - b) ** 2 for a, b in zip(low, high)) ** .5
        markers = rows_of(os.path.join(case, "markers.csv"))[1:]
        truth_file = os.path.join(case, "truth.csv")
        truth = [[float(x) for x in r] for r in rows_of(truth_file)[1:]] if os.path.exists(truth_file) else None
        for axis in range(3):
            limit = sorted(p[axis] for p in points)[int(KEPT * len(points))]
            inside = lambda p: float(p[axis]) < limit
            kept = [r for r in markers if inside(r[4:7])]
            if len(kept) < LEAST_MARKERS:
                continue
            part_file = os.path.join(folder, "part.obj")
            write_obj(part_file, points, largest_piece([f for f in faces if all(inside(points[i]) for i in f)]))
            score = "–"
            if truth and not isinstance(fit(program, source, target, markers, folder), str):
                score = "/ %.3f" % truth_within(folder, truth, inside, size)
            part = fit(program, source, part_file, kept, folder)
            if truth and not isinstance(part, str):
                score = "%.3f %s" % (truth_within(folder, truth, inside, size), score)
            lines.append(row_of("%s, %s < %.3g" % (os.path.basename(case), "xyz"[axis], limit), part, score))
            print(lines[-1], file=sys.stderr)
    return lines
