"""What seams cost: each case of a data folder as it is, and with its meshes' numbering cut.

Meshes are cut between random patches and along random walks on edges, with the copies of vertices at the end, and
once more into single triangles ("flat"). Every verb should give what it gives for the whole mesh. A row a case and cut:
how far vertices end from where the whole mesh's do, the most, in parts of the diagonal; "same" to the last bit. For
measure and transfer the most by which a number differs, in parts of the number or of the largest of its column.

    tools/seams.py PROGRAM DATA [CASE...]
"""
import collections
import json
import math
import os
import random
import sys
import tempfile

from cases import markers_of, rows_of, run, write_rows

PATCHES, WALKS, STEPS = 15, 30, 40


def read_obj(path):
    points, faces = [], []
    with open(path) as f:
        for line in f:
            cells = line.split()
            if cells[:1] == ["v"]:
                points.append(tuple(map(float, cells[1:4])))
            elif cells[:1] == ["f"]:
                corners = [int(c.split("/")[0]) - 1 for c in cells[1:]]
                faces += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
    return points, faces


def write_obj(path, points, faces):
    with open(path, "w") as f:
        f.writelines("v %r %r %r\n" % p for p in points)
        f.writelines("f %d %d %d\n" % tuple(v + 1 for v in t) for t in faces)


def edges_of(faces):
    on = collections.defaultdict(list)
    for t, face in enumerate(faces):
        for k in range(3):
            on[tuple(sorted((face[k], face[k - 2])))].append(t)
    return on


def random_seams(points, faces, seed):
    """Edges: between patches that grow from random triangles, and along walks that end anywhere."""
    dice, on = random.Random(seed), edges_of(faces)
    beside, around = collections.defaultdict(list), collections.defaultdict(list)
    for (a, b), triangles in on.items():
        around[a].append(b), around[b].append(a)
        if len(triangles) == 2:
            beside[triangles[0]].append(triangles[1]), beside[triangles[1]].append(triangles[0])
    patch, front = {}, []
    for p in range(PATCHES):
        front.append(dice.randrange(len(faces)))
        patch[front[-1]] = p
    for t in front:
        for u in beside[t]:
            if u not in patch:
                patch[u] = patch[t]
                front.append(u)
    cut = {e for e, t in on.items() if len(t) == 2 and patch.get(t[0]) != patch.get(t[1])}
    for _ in range(WALKS):
        v = dice.randrange(len(points))
        for _ in range(STEPS):
            if not around[v]:
                break
            w = dice.choice(around[v])
            cut.add((min(v, w), max(v, w)))
            v = w
    return cut


def cut_along(points, faces, cut):
    """The cut mesh and which vertex each was. Fans around a vertex that the seams part get copies of it."""
    faces, was = [list(f) for f in faces], list(range(len(points)))
    around = collections.defaultdict(list)
    for t, face in enumerate(faces):
        for v in face:
            around[v].append(t)
    whole = [tuple(f) for f in faces]
    for v in sorted({v for e in cut for v in e}):
        left, fans = list(around[v]), []
        while left:
            fan = [left.pop(0)]
            for t in fan:
                for w in whole[t]:
                    if w != v and (min(v, w), max(v, w)) not in cut:
                        fan += [u for u in left if w in whole[u]]
                        left = [u for u in left if w not in whole[u]]
            fans.append(fan)
        for fan in fans[1:]:
            for t in fan:
                faces[t][whole[t].index(v)] = len(was)
            was.append(v)
    return faces, was


def flat(faces):
    return [(3 * t, 3 * t + 1, 3 * t + 2) for t in range(len(faces))], [v for f in faces for v in f]


def corners(path):
    points, faces = read_obj(path)
    return [points[v] for f in faces for v in f]


def apart(a, b, size):
    if len(a) != len(b):
        return math.inf
    return max((math.dist(p, q) for p, q in zip(a, b) if p != q), default=0) / size


def diagonal(points):
    return math.dist([min(c) for c in zip(*points)], [max(c) for c in zip(*points)])


def numbers(value):
    if isinstance(value, dict):
        return [n for k in sorted(value) if k not in ("vertices", "copies_of_vertices") for n in numbers(value[k])]
    if isinstance(value, list):
        return [n for v in value for n in numbers(v)]
    return [float(value)] if isinstance(value, (int, float)) else []


def relative(a, b):
    if len(a) != len(b):
        return math.inf
    return max((abs(x - y) / max(abs(x), abs(y), 1e-3) for x, y in zip(a, b) if x != y), default=0)


class Case:
    """One pair of meshes, whole or cut, in a folder of its own, and what the verbs make of it."""

    def __init__(self, program, folder, source, target, markers):
        self.program, self.folder = program, folder
        self.was = source[2]
        write_obj(self.at("source.obj"), [source[0][v] for v in source[2]], source[1])
        write_obj(self.at("target.obj"), [target[0][v] for v in target[2]], target[1])
        self.markers = ["--markers", markers] if markers else []
        self.size = diagonal(target[0])

    def at(self, name):
        return os.path.join(self.folder, name)

    def do(self, *arguments):
        done, _ = run([self.program, *arguments])
        if done.returncode != 0:
            raise RuntimeError(" ".join(arguments) + ": " + done.stderr.strip())
        return done.stdout

    def results(self, shapes):
        """By verb: corners of a mesh, or numbers. `shapes`: the whole mesh's vertices in two shapes, for the path."""
        source, target, fitted = self.at("source.obj"), self.at("target.obj"), self.at("fitted.obj")
        found = {}
        self.do("fit", source, target, *self.markers, "--quiet", "-o", fitted)
        found["fit"] = corners(fitted)
        self.do("fit", source, target, *self.markers, "--quiet", "-o", self.at("refined.obj"), "--refine",
                self.at("finer.obj"))
        found["refine"] = corners(self.at("refined.obj")) + corners(self.at("finer.obj"))
        faces = read_obj(source)[1]
        for name, shape in zip(("from.obj", "to.obj"), shapes):
            write_obj(self.at(name), [shape[v] for v in self.was], faces)
        self.do("tween", self.at("from.obj"), self.at("to.obj"), "--quiet", "--at", "0.4", "-o", self.at("half.obj"))
        found["path"] = corners(self.at("half.obj"))
        found["measure"] = numbers(json.loads(self.do("measure", self.at("from.obj"), self.at("to.obj"), target,
                                                      "--quiet")))
        write_rows(self.at("values.csv"), [shapes[0][v] for v in self.was])
        self.do("transfer", self.at("to.obj"), target, "--to", "target", "--quiet", "--values", self.at("values.csv"),
                "--values-out", self.at("carried.csv"))
        carried = [[float(c) for c in row] for row in rows_of(self.at("carried.csv"))]
        found["transfer"] = [tuple(carried[v]) for f in read_obj(target)[1] for v in f]
        return found


def told(distance):
    return "same" if distance == 0 else "%.1e" % distance


def main(program, data, *chosen):
    verbs = ["fit", "refine", "path", "measure", "transfer"]
    print("| case | cut | copies |", " | ".join(verbs), "|")
    print("|---" * (3 + len(verbs)) + "|")
    worst = 0
    for name in chosen or sorted(os.listdir(data)):
        case = os.path.join(data, name)
        if not os.path.exists(os.path.join(case, "source.obj")):
            continue
        source, target = (read_obj(os.path.join(case, f)) for f in ("source.obj", "target.obj"))
        markers = os.path.join(case, "markers.csv") if markers_of(case) else None
        with tempfile.TemporaryDirectory() as scratch:
            def made(kind, cut):
                folder = os.path.join(scratch, kind)
                os.mkdir(folder)
                return Case(program, folder, *((p, *cut(p, f)) for p, f in (source, target)), markers)

            whole = made("whole", lambda p, f: (f, list(range(len(p)))))
            whole.do("fit", whole.at("source.obj"), whole.at("target.obj"), *whole.markers, "--quiet", "-o",
                     whole.at("fitted.obj"))
            shapes = source[0], read_obj(whole.at("fitted.obj"))[0]
            want = whole.results(shapes)
            for kind, cut in (("seams", lambda p, f: cut_along(p, f, random_seams(p, f, 1))),
                              ("flat", lambda p, f: flat(f))):
                split = made(kind, cut)
                have = split.results(shapes)
                row = [relative(want[v], have[v]) if v == "measure" else apart(want[v], have[v], whole.size)
                       for v in verbs]
                worst = max([worst, *row])
                print("|", name, "|", kind, "|", len(split.was) - len(source[0]), "|", " | ".join(map(told, row)), "|",
                      flush=True)
    print("\nat worst %.1e" % worst)
    return worst > 1e-9


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
