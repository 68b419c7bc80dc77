"""Folders of cases: what quality.py, crossed.py and partial.py share."""
import csv
import json
import os
import subprocess
import time

MARKER_COLUMNS = ["name", "sx", "sy", "sz", "tx", "ty", "tz"]


def run(arguments):
    start = time.time()
    done = subprocess.run(arguments, capture_output=True, text=True)
    return done, time.time() - start


def rows_of(path):
    with open(path) as f:
        return [r for r in csv.reader(f) if r]


def write_rows(path, rows):
    with open(path, "w", newline="") as f:
        csv.writer(f).writerows(rows)


def markers_of(case):
    path = os.path.join(case, "markers.csv")
    return os.path.exists(path) and len(rows_of(path)) > 1


def fit(program, source, target, markers, folder, extra=()):
    """What the report says of a fit with these rows of markers, or why there is none; the mesh is fitted.obj."""
    path, report = os.path.join(folder, "markers.csv"), os.path.join(folder, "report.json")
    write_rows(path, [MARKER_COLUMNS] + markers)
    done, _ = run([program, "fit", source, target, "--markers", path, "--quiet", "-o", os.path.join(folder, "fitted.obj"),
                   "--report", report, *extra])
    if done.returncode != 0:
        return done.stderr.strip()
    with open(report) as f:
        return json.load(f)["fit"]
