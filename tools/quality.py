#!/usr/bin/env python3
"""Fits and morphs every case of a data folder and writes the tables of docs/quality.md.

    quality.py PROGRAM DATA [--ruler EVALUATE] [--only WORD] [--fit METHOD ...] [--few] [--large] [--crossed] [--partial]
               [--noisy] [--write docs/quality.md]

A case is a folder with case.json, source.obj and target.obj; with markers.csv it is fitted, and with one connectivity on
both sides every path is tried. All figures are the program's own (measure, and the report); with --ruler an independent
program measures the same fits and the largest disagreement is told. Where a case has no truth, every third marker
is held out of a second fit and scored (7 of an animal's 21). Cases of tools/peers.json get a table with the peers' figures
beside ours; --few adds fits with few markers, --large ever larger meshes, --crossed pairs of shapes that no case holds,
--partial targets of which a part is cut off, --noisy markers that are not quite where they belong. Needs nothing but Python's standard library.
"""
import argparse
import csv
import json
import os
import sys
import tempfile

from cases import markers_of, rows_of, run
from crossed import crossed_table
from noisy import noisy_table
from partial import partial_table

BEGIN, END = "<!-- made by ./dev quality: begin -->", "<!-- end -->"


def split(path, folder):
    """Two marker files: two thirds to fit with, one third to score."""
    rows = rows_of(path)
    head, body = rows[:1], rows[1:]
    files = []
    for name, keep in (("train", lambda i: i % 3 != 2), ("test", lambda i: i % 3 == 2)):
        files.append(os.path.join(folder, name + ".csv"))
        with open(files[-1], "w", newline="") as f:
            csv.writer(f).writerows(head + [r for i, r in enumerate(body) if keep(i)])
    return files


def fit_case(program, case, folder, method, ruler):
    source, target = os.path.join(case, "source.obj"), os.path.join(case, "target.obj")
    markers, truth = os.path.join(case, "markers.csv"), os.path.join(case, "truth.csv")
    fitted, report = os.path.join(folder, "fitted.obj"), os.path.join(folder, "report.json")
    fit = [program, "fit", source, target, "--fit", method, "--quiet", "-o", fitted]
    done, _ = run(fit + ["--markers", markers, "--report", report])
    name = os.path.basename(case)
    if done.returncode != 0:
        return {"case": name, "failed": done.stderr.strip()}
    with open(report) as f:
        found = json.load(f)
    row = {"case": name, "fit": found["fit"], "memory": found["peak_memory_mib"], "vertices": found["source"]["vertices"]}
    measure = [program, "measure", source, fitted, target, "--quiet"]
    if os.path.exists(truth):
        row["quality"] = json.loads(run(measure + ["--truth", truth, "--markers", markers])[0].stdout)
        row["score"] = "%.3f" % row["quality"]["truth_error"]["mean"]
    else:
        row["quality"] = found["fit"]["quality"]
        train, test = split(markers, folder)
        done, _ = run(fit[:-1] + [os.path.join(folder, "held.obj"), "--markers", train])
        held = json.loads(run([program, "measure", source, os.path.join(folder, "held.obj"), target, "--quiet", "--markers",
                               test])[0].stdout)
        row["score"] = "(%.2f)" % held["marker_error"]["mean"]
    if ruler:
        extra = ["--truth", truth] if os.path.exists(truth) else []
        row["ruler"] = json.loads(run([ruler, "fit", source, fitted, target, "--markers", markers] + extra)[0].stdout)
    return row


def disagreement(row):
    """The largest relative difference between our measures and the ruler's, and the counts that differ."""
    ours, theirs = row["quality"], row["ruler"]
    worst = 0
    for key, other in (("fitted_to_target", "result_to_target"), ("target_to_fitted", "target_to_result"),
                       ("vertex_to_target", "vertex_to_target"), ("symmetric_dirichlet", "symmetric_dirichlet"),
                       ("truth_error", "truth_error")):
        for of in ("mean", "p99"):
            if key in ours:
                a, b = ours[key][of], theirs["%s_%s" % (other, of)]
                worst = max(worst, abs(a - b) / max(abs(b), 1e-3))
    counts = ["%s %d/%d" % (k, ours[k], theirs[k]) for k in
              ("flipped_faces", "degenerate_faces", "self_intersections", "self_intersections_source",
               "self_intersections_target") if ours[k] != theirs[k]]
    return worst, counts


def fit_table(rows):
    lines = ["| case | vertices | RMS of Eq. 7 | there | back | back99 | truth (held out) | markers | flips | cuts (source + target) | sd99 "
             "| seconds | MiB |", "|---|" + "---|" * 12]
    for r in rows:
        if "failed" in r:
            lines.append("| %s | failed: %s |" % (r["case"], r["failed"]))
            continue
        q = r["quality"]
        lines.append("| %s | %d | %.2g | %.3f | %.3f | %.2f | %s | %.3f | %d | %d (%d + %d) | %.3g | %.1f | %.0f |" % (
            r["case"], r["vertices"], (q["eq7"] / r["vertices"]) ** .5, q["fitted_to_target"]["mean"], q["target_to_fitted"]["mean"],
            q["target_to_fitted"]["p99"], r["score"], q["marker_error"]["mean"], q["flipped_faces"], q["self_intersections"],
            q["self_intersections_source"], q["self_intersections_target"], q["symmetric_dirichlet"]["p99"],
            r["fit"]["seconds"], r["memory"]))
    return lines


PEERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "peers.json")
COLUMNS = (("truth", "%.3f"), ("there", "%.3f"), ("back", "%.3f"), ("back99", "%.2f"), ("flips", "%d"), ("cuts", "%d"),
           ("sd99", "%.3g"), ("seconds", "%.1f"), ("mb", "%.0f"))


def our_figures(row, method):
    q = row["quality"]
    ours = {"system": "**meshtween, `--fit %s`**" % method, "there": q["fitted_to_target"]["mean"],
            "back": q["target_to_fitted"]["mean"], "back99": q["target_to_fitted"]["p99"], "flips": q["flipped_faces"],
            "cuts": q["self_intersections"], "sd99": q["symmetric_dirichlet"]["p99"], "seconds": row["fit"]["seconds"],
            "mb": row["memory"]}
    if "truth_error" in q:
        ours["truth"] = q["truth_error"]["mean"]
    return ours


def peer_tables(ours, peers):
    """For each case: ours and the peers', the best of each column in bold, and the columns where we are not it."""
    lines = []
    for case in sorted(set(ours) & set(peers["cases"])):
        rows = ours[case] + peers["cases"][case]
        # a small distortion is no merit where the target was not reached
        best = {key: min((r[key] for r in rows if key in r and key != "sd99"), default=None) for key, _ in COLUMNS}
        lines += ["", "**%s**" % case, "", "| system | " + " | ".join(key for key, _ in COLUMNS) + " |", "|---|" + "---|" * len(COLUMNS)]
        for r in rows:
            cells = ["–" if key not in r else ("**%s**" if r[key] == best[key] else "%s") % (form % r[key]) for key, form in COLUMNS]
            lines.append("| %s | %s |" % (r["system"], " | ".join(cells)))
        first = ours[case][0]
        behind = ["%s (%s, %s)" % (key, form % best[key], next(r["system"] for r in rows if r.get(key) == best[key]))
                  for key, form in COLUMNS if best[key] is not None and key in first and first[key] > best[key]]
        lines += ["", "Behind the best in: %s." % ", ".join(behind) if behind else "The best in every column."]
    return lines


def spread_out(rows):
    """Marker rows in the order of farthest-point sampling on the source, from the one farthest from their middle."""
    points = [tuple(float(x) for x in r[1:4]) for r in rows]
    middle = tuple(sum(p[k] for p in points) / len(points) for k in range(3))
    square = lambda a, b: sum((x - y) ** 2 for x, y in zip(a, b))
    order = [max(range(len(points)), key=lambda i: (square(points[i], middle), -i))]
    nearest = [square(p, points[order[0]]) for p in points]
    while len(order) < len(points):
        order.append(max((i for i in range(len(points)) if i not in order), key=lambda i: (nearest[i], -i)))
        nearest = [min(n, square(p, points[order[-1]])) for n, p in zip(nearest, points)]
    return [rows[i] for i in order]


def few_cell(program, case, folder, count):
    """Mean error with so many markers: of all vertices where the truth is known, else of the markers left out."""
    source, target = os.path.join(case, "source.obj"), os.path.join(case, "target.obj")
    rows = rows_of(os.path.join(case, "markers.csv"))
    order = spread_out(rows[1:])
    names = {"few.csv": order[:count], "rest.csv": order[count:]}
    for name, body in names.items():
        with open(os.path.join(folder, name), "w", newline="") as f:
            csv.writer(f).writerows(rows[:1] + body)
    fitted, truth = os.path.join(folder, "few.obj"), os.path.join(case, "truth.csv")
    done, _ = run([program, "fit", source, target, "--quiet", "-o", fitted] +
                  (["--markers", os.path.join(folder, "few.csv")] if count else []))
    if done.returncode != 0:
        return "failed"
    measure = [program, "measure", source, fitted, target, "--quiet"]
    if os.path.exists(truth):
        found = json.loads(run(measure + ["--truth", truth])[0].stdout)
        return "%.3f / %.3f" % (found["truth_error"]["mean"], found["target_to_fitted"]["mean"])
    if not names["rest.csv"]:
        found = json.loads(run(measure)[0].stdout)
        return "– / %.3f" % found["target_to_fitted"]["mean"]
    found = json.loads(run(measure + ["--markers", os.path.join(folder, "rest.csv")])[0].stdout)
    return "(%.2f) / %.3f" % (found["marker_error"]["mean"], found["target_to_fitted"]["mean"])


def few_table(program, cases, folder, counts=(40, 20, 10, 5, 0)):
    lines = ["| case | all up to %d | " % counts[0] + " | ".join("%d markers" % c for c in counts[1:]) + " |",
             "|---|" + "---|" * len(counts)]
    for case in cases:
        there_are = len(rows_of(os.path.join(case, "markers.csv"))) - 1
        counted = [min(counts[0], there_are)] + list(counts[1:])
        cells = [few_cell(program, case, folder, c) if c <= there_are else "–" for c in counted]
        lines.append("| %s | %s |" % (os.path.basename(case), " | ".join(cells)))
        print(lines[-1], file=sys.stderr)
    return lines


def large_table(program, folder, methods, most=2):
    """Time and memory with the size of the mesh: a sample's bodies, each triangle cut in four again and again."""
    lines = ["| vertices | " + " | ".join("`--fit %s`: seconds / MiB" % m for m in methods) + " |", "|---|" + "---|" * len(methods)]
    for subdivide in range(most + 1):
        run([program, "sample", "bow", "--subdivide", str(subdivide), "-o", folder, "--quiet"])
        name = lambda what: os.path.join(folder, "bow_" + what)
        cells = []
        for method in methods:
            report = os.path.join(folder, "large.json")
            run([program, "fit", name("source.ply"), name("target.ply"), "--markers", name("markers.csv"), "--fit", method, "--quiet",
                 "-o", os.path.join(folder, "large.ply"), "--report", report])
            with open(report) as f:
                found = json.load(f)
            cells.append("%.1f / %.0f" % (found["fit"]["seconds"], found["peak_memory_mib"]))
        lines.append("| %d | %s |" % (found["source"]["vertices"], " | ".join(cells)))
        print(lines[-1], file=sys.stderr)
    return lines


def same_connectivity(case):
    with open(os.path.join(case, "case.json")) as f:
        info = json.load(f)
    return os.path.basename(case).startswith("interp_") or info.get("same_connectivity", False)


def path_table(program, cases, folder, methods):
    lines = ["| case | " + " | ".join(methods) + " |", "|---|" + "---|" * len(methods)]
    for case in cases:
        cells = []
        for method in methods:
            report = os.path.join(folder, "path.json")
            done, _ = run([program, "tween", os.path.join(case, "source.obj"), os.path.join(case, "target.obj"), "--method", method,
                           "--quiet", "--no-repair", "-o", os.path.join(folder, "f_##.ply"), "--frames", "3", "--report", report])
            if done.returncode != 0:
                cells.append("failed")
                continue
            with open(report) as f:
                shapes = {s["u"]: s for s in json.load(f)["path"]["shapes"]}
            ends = (shapes[0]["volume"] + shapes[1]["volume"]) / 2
            cells.append("%.3f / %.2f" % (shapes[.5]["volume"] / ends, shapes[.5]["edge_strain_percent"]))
        lines.append("| %s | %s |" % (os.path.basename(case), " | ".join(cells)))
    return lines


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("program")
    ap.add_argument("data")
    ap.add_argument("--ruler", help="an independent program that measures the same fits")
    ap.add_argument("--only", default="", help="cases whose name holds this word")
    ap.add_argument("--fit", nargs="+", default=["paper"])
    ap.add_argument("--methods", nargs="+", default=["linear", "laplacian", "dual-as-printed", "dual", "rigid"])
    ap.add_argument("--few", action="store_true", help="also fit with 40, 20, 10, 5 and 0 markers")
    ap.add_argument("--large", action="store_true", help="also time fits of meshes of up to 190,000 vertices")
    ap.add_argument("--crossed", action="store_true", help="also fit pairs made by crossing the cases' shapes")
    ap.add_argument("--partial", action="store_true", help="also fit to targets of which a part is cut off")
    ap.add_argument("--noisy", action="store_true", help="also fit with markers that are not quite where they belong")
    ap.add_argument("--write", help="put the tables between the marks of this page")
    a = ap.parse_args()
    cases = sorted(os.path.join(a.data, d) for d in os.listdir(a.data)
                   if a.only in d and os.path.exists(os.path.join(a.data, d, "case.json")))
    text = []
    with tempfile.TemporaryDirectory() as folder:
        fits = [c for c in cases if markers_of(c)]
        beside_peers = {}
        for method in a.fit:
            rows = []
            for case in fits:
                rows.append(fit_case(a.program, case, folder, method, a.ruler))
                print(fit_table(rows)[-1], file=sys.stderr)
                if a.ruler and "ruler" in rows[-1]:
                    worst, counts = disagreement(rows[-1])
                    print("  against the ruler: within %.2g, %s" % (worst, ", ".join(counts) or "all counts the same"), file=sys.stderr)
                if "failed" not in rows[-1]:
                    beside_peers.setdefault(rows[-1]["case"], []).append(our_figures(rows[-1], method))
            if rows:
                text += ["", "### Fits, `--fit %s`" % method, ""] + fit_table(rows)
        with open(PEERS) as f:
            peers = json.load(f)
        tables_beside = peer_tables(beside_peers, peers)
        if tables_beside:
            text += ["", "### Beside other systems", "", peers["origin"], "", "Columns: %s" % peers["units"]] + tables_beside
        if a.few and fits:
            text += ["", "### With fewer markers", "", "Mean error / back. The error is that of the vertices, or in brackets that "
                     "of the markers left out. Markers are taken in the order of farthest-point sampling.", ""]
            text += few_table(a.program, fits, folder)
        if a.large:
            text += ["", "### Large meshes", "", "The sample `bow`, 40 markers, with `--subdivide` 0 to 2. Memory includes reading and "
                     "measuring.", ""]
            text += large_table(a.program, folder, a.fit)
        if a.crossed and fits:
            text += ["", "### Pairs made by crossing", "", "Shapes of different cases, paired where their markers have the same names, and "
                     "cases turned round. Three fits each, with marker weights 1, 0.97 and 1.03, which to the eye are the same: flips and "
                     "cuts of all three, else their means.", ""]
            text += crossed_table(a.program, fits, folder)
        if a.partial and fits:
            text += ["", "### Targets of which a part is there", "", "Of each target three fifths, cut off along an axis. *beyond*: "
                     "vertices that the target ends before. *truth*: mean error of those whose true place is on the part, fitted to it "
                     "and to the whole target, in percent of the whole target's diagonal. *flips*: without those beyond.", ""]
            text += partial_table(a.program, fits, folder)
        if a.noisy and fits:
            text += ["", "### Markers as people place them", "", "On the target: where they belong; with a normal error of 1 % of the "
                     "diagonal in each coordinate; 2 % off the surface. *truth*: mean distance of the vertices from where they belong.", ""]
            text += noisy_table(a.program, fits, folder)
        paths = [c for c in cases if same_connectivity(c)]
        if paths:
            text += ["", "### Paths at u = 0.5: volume / edge strain in %", ""] + path_table(a.program, paths, folder, a.methods)
    tables = "\n".join(text)
    if a.write:
        with open(a.write) as f:
            page = f.read()
        head, rest = page.split(BEGIN)
        with open(a.write, "w") as f:
            f.write(head + BEGIN + "\n" + tables + "\n\n" + END + rest.split(END)[1])
    else:
        print(tables)


if __name__ == "__main__":
    main()
