#!/usr/bin/env python3
"""Reads a landmark file by its format's own rules, apart from the library, and prints a JSON list of sides: each a list of
[name or null, [x, y, z] or null]."""
import csv
import json
import re
import sys
import xml.etree.ElementTree as xml


def point(words, missing=None):
    if len(words) != 3:
        raise SystemExit(f"three coordinates, not {words}")
    if all(w in ("NA", "NaN", "") for w in words) or (missing is not None and all(float(w) == missing for w in words)):
        return None
    return [float(w) for w in words]


def table(path, dialect):
    rows = list(csv.reader(open(path, newline="", encoding="utf-8"), dialect))
    header, rows = rows[0], rows[1:]
    columns = [["x", "y", "z"]] if "x" in header else [["sx", "sy", "sz"], ["tx", "ty", "tz"]]
    return [[[r[header.index("name")], point([r[header.index(c)] for c in names])] for r in rows] for names in columns]


def picked_points(path):
    return [[[p.get("name"), point([p.get(c) for c in "xyz"]) if p.get("active") == "1" else None]
             for p in xml.parse(path).getroot().iter("point")]]


def fcsv(path):
    lines = open(path, encoding="utf-8").read().splitlines()
    assert lines[0].startswith("# Markups fiducial file version = ") and re.match("# CoordinateSystem = (LPS|RAS)$", lines[1])
    assert lines[2].startswith("# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID")
    return [[[r[11], point(r[1:4]) if r[14] == "2" else None] for r in csv.reader(lines[3:])]]


def markups(path):
    file = json.load(open(path, encoding="utf-8"))
    assert file["markups"][0]["type"] == "Fiducial" and file["markups"][0]["coordinateSystem"] in ("LPS", "RAS")
    return [[[p["label"], p["position"] if p["positionStatus"] == "defined" else None]
             for p in file["markups"][0]["controlPoints"]]]


def wrap(path, mesh):
    vertices, faces = [], []
    for line in open(mesh):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(w) for w in words[1:4]])
        if words[:1] == ["f"]:
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    at = lambda t, u, v: [sum(w * vertices[i][k] for w, i in zip((u, v, 1 - u - v), faces[t])) for k in range(3)]
    return [[[None, at(*entry)] for entry in json.load(open(path))]]


def pts(path):
    lines = open(path, encoding="utf-8").read().splitlines()
    assert lines[0] == "Version 1.0" and int(lines[1]) == len(lines) - 2
    return [[[line.split(" ")[0], point(line.split(" ")[1:], 9999)] for line in lines[2:]]]


def dta(path):
    lines = [line.strip() for line in open(path, encoding="utf-8") if line.strip() and line[0] != "'"]
    one, rows, columns, has_missing, missing, dimensions = lines[0].split()
    assert one == "1" and rows.endswith("L") and dimensions.upper() == "DIM=3"
    n, p = int(rows[:-1]), int(columns) // 3
    assert len(lines) == 1 + n + n * p
    points = [point(line.split(), float(missing) if has_missing == "1" else None) for line in lines[1 + n:]]
    return [[[None, q] for q in points[i * p:(i + 1) * p]] for i in range(n)]


def tps(path):
    sides = []
    for line in open(path, encoding="utf-8").read().splitlines():
        if line.startswith("LM3="):
            sides.append([])
            count = int(line[4:])
        elif line.startswith("ID="):
            assert len(sides[-1]) == count and line[3:]
        else:
            sides[-1].append([None, point(line.split())])
    return sides


def morphologika(path):
    sections = {}
    for line in open(path, encoding="utf-8").read().splitlines():
        if line.startswith("["):
            sections[line.strip("[]").lower()] = here = []
        elif line.strip():
            here.append(line)
    n, p, k = (int(sections[s][0]) for s in ("individuals", "landmarks", "dimensions"))
    rows = [r for r in sections["rawpoints"] if not r.startswith("'")]
    assert k == 3 and len(sections["names"]) == n and len(rows) == n * p
    return [[[None, point(r.split())] for r in rows[i * p:(i + 1) * p]] for i in range(n)]


def amira(path):
    text = open(path, encoding="utf-8").read()
    assert text.startswith("# AmiraMesh 3D ASCII 2.0\n") and 'ContentType "LandmarkSet"' in text
    count, sets = int(re.search(r"define Markers (\d+)", text)[1]), int(re.search(r"NumSets (\d+)", text)[1])
    body = text.split("# Data section follows")[1]
    sides = []
    for k in range(1, sets + 1):
        rows = re.search(rf"^@{k}\n(.*?)(?:\n@|\Z)", body, re.S | re.M)[1].split("\n")
        sides.append([[None, point(r.split())] for r in rows if r.strip()])
        assert len(sides[-1]) == count
    return sides


def main(path, mesh=None):
    name = path.lower()
    readers = [(".mrk.json", markups), (".json", lambda p: wrap(p, mesh)), (".csv", lambda p: table(p, "excel")),
               (".tsv", lambda p: table(p, "excel-tab")), (".pp", picked_points), (".fcsv", fcsv), (".pts", pts), (".dta", dta),
               (".tps", tps), (".txt", morphologika), (".landmarkascii", amira)]
    json.dump(next(read for end, read in readers if name.endswith(end))(path), sys.stdout)


if __name__ == "__main__":
    main(*sys.argv[1:])
