"""Pairs that no case of a data folder holds, made by crossing its shapes.

Shapes whose cases share the same marker names are paired with each other, both ways; markers that are only numbered
(m01) mean something else in each case, and such cases are only turned round. Each pair is fitted with three marker
weights: 3 % more or less changes no fit to the eye, so the spread is how far chance decides.
"""
import itertools
import os
import re
import sys

from cases import fit, rows_of

WEIGHTS = ("1", "0.97", "1.03")


def shapes_of(case):
    """Both sides of a case: name, file, and the markers' names and places."""
    first, second = os.path.basename(case).split("_to_")
    first = first.split("_")[-1]
    rows = rows_of(os.path.join(case, "markers.csv"))[1:]
    names = [r[0] for r in rows]
    return ({"name": first, "file": os.path.join(case, "source.obj"), "names": names, "places": [r[1:4] for r in rows]},
            {"name": second + "2" * (first == second), "file": os.path.join(case, "target.obj"), "names": names,
             "places": [r[4:7] for r in rows]})


def new_pairs(cases):
    sides = [shapes_of(case) for case in cases if "_to_" in os.path.basename(case)]
    groups = {}
    for k, (source, target) in enumerate(sides):
        numbered = all(re.fullmatch(r"[a-z]?\d+", n) for n in source["names"])
        shapes = groups.setdefault(k if numbered else tuple(source["names"]), {})
        for shape in (source, target):
            shapes.setdefault(shape["name"], shape)
    known = {(s["name"], t["name"]) for s, t in sides}
    return [(s, t) for shapes in groups.values() for s, t in itertools.permutations(shapes.values(), 2)
            if (s["name"], t["name"]) not in known]


def row_of(name, fits):
    failed = [f for f in fits if isinstance(f, str)]
    if failed:
        return "| %s | failed: %s |" % (name, failed[0])
    measured = [f["quality"] for f in fits]
    mean = lambda key: sum(q[key]["mean"] for q in measured) / len(fits)
    return "| %s | %.3f | %.3f | %.3f | %s | %s (%d + %d) | %.1f |" % (
        name, mean("fitted_to_target"), mean("target_to_fitted"), mean("marker_error"),
        ", ".join(str(f["guards"]["flips_left"]) for f in fits), ", ".join(str(q["self_intersections"]) for q in measured),
        measured[0]["self_intersections_source"], measured[0]["self_intersections_target"],
        sum(f["seconds"] for f in fits) / len(fits))


def crossed_table(program, cases, folder):
    lines = ["| pair | there | back | markers | flips | cuts (source + target) | seconds |", "|---|" + "---|" * 6]
    for source, target in new_pairs(cases):
        markers = [[n] + a + b for n, a, b in zip(source["names"], source["places"], target["places"])]
        fits = [fit(program, source["file"], target["file"], markers, folder, ("--marker-weight", w)) for w in WEIGHTS]
        lines.append(row_of("%s_to_%s" % (source["name"], target["name"]), fits))
        print(lines[-1], file=sys.stderr)
    return lines
