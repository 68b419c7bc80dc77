#!/usr/bin/env python3
"""Fits and morphs every case of a data folder and writes the tables of docs/quality.md.

    quality.py PROGRAM DATA [--ruler EVALUATE] [--only WORD] [--fit METHOD ...] [--write docs/quality.md]

A case is a folder with case.json, source.obj and target.obj; with markers.csv it is fitted, and with one connectivity on
both sides every path is tried. All figures are the program's own (measure, and the report); with --ruler an independent
program measures the same fits and the largest disagreement is told. Where a case has no truth, every third marker
is held out of a second fit and scored. Needs nothing but Python's standard library.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
import time

BEGIN, END = "<!-- made by ./dev quality: begin -->", "<!-- end -->"


def run(arguments):
    start = time.time()
    done = subprocess.run(arguments, capture_output=True, text=True)
    return done, time.time() - start


def rows_of(path):
    with open(path) as f:
        return [r for r in csv.reader(f) if r]


def markers_of(case):
    path = os.path.join(case, "markers.csv")
    return os.path.exists(path) and len(rows_of(path)) > 1


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
                           "--quiet", "-o", os.path.join(folder, "f_##.ply"), "--frames", "3", "--report", report])
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
    ap.add_argument("--write", help="put the tables between the marks of this page")
    a = ap.parse_args()
    cases = sorted(os.path.join(a.data, d) for d in os.listdir(a.data)
                   if a.only in d and os.path.exists(os.path.join(a.data, d, "case.json")))
    text = []
    with tempfile.TemporaryDirectory() as folder:
        fits = [c for c in cases if markers_of(c)]
        for method in a.fit:
            rows = []
            for case in fits:
                rows.append(fit_case(a.program, case, folder, method, a.ruler))
                print(fit_table(rows)[-1], file=sys.stderr)
                if a.ruler and "ruler" in rows[-1]:
                    worst, counts = disagreement(rows[-1])
                    print("  against the ruler: within %.2g, %s" % (worst, ", ".join(counts) or "all counts the same"), file=sys.stderr)
            if rows:
                text += ["", "### Fits, `--fit %s`" % method, ""] + fit_table(rows)
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
