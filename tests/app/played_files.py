"""Writes what viewers are compared on: played_files.py MESHTWEEN FOLDER.

For each case NAME.glb and NAME.usda, and NAME.json: {seconds, tolerance, moments: [{t, vertices}]}, the shapes that `tween --at` gives
where the animation is at t (0 to 1). They come from the path's own solve, not from the curve that the GLB holds.
"""
import json
import subprocess
import sys
from pathlib import Path

program, folder = sys.argv[1], Path(sys.argv[2])
TOLERANCE = 1e-4  # of curves
MOMENTS = [0, 0.05, 0.13, 0.31, 0.44, 0.5, 0.62, 0.77, 0.9, 1]
EASES = {"linear": lambda t: t, "in-out": lambda t: t * t * (3 - 2 * t)}


def run(*arguments):
    subprocess.run([program, *map(str, arguments), "--quiet"], check=True)


def vertices(obj):
    lines = (line.split() for line in Path(obj).read_text().splitlines() if line.startswith("v "))
    return [float(word) for line in lines for word in line[1:4]]


def write_case(name, meshes, *options, ease="linear"):
    common = ["tween", *(folder / mesh for mesh in meshes), "--no-repair", *options]
    report = folder / f"{name}_report.json"
    run(*common, "--ease", ease, "--seconds", 2, "--report", report, "-o", folder / f"{name}.glb", "-o", folder / f"{name}.usda")
    told = json.loads(report.read_text())["path"]["curve"]
    assert told["deviation"] <= TOLERANCE, told
    print(name, told)
    moments = []
    for t in MOMENTS:
        run(*common, "--at", EASES[ease](t), "-o", folder / "at.obj")
        moments.append({"t": t, "vertices": vertices(folder / "at.obj")})
    (folder / f"{name}.json").write_text(json.dumps({"seconds": 2, "tolerance": TOLERANCE, "moments": moments}))


folder.mkdir(parents=True, exist_ok=True)
run("sample", "bow", "-o", folder)
run("fit", folder / "bow_source.ply", folder / "bow_target.ply", "--markers", folder / "bow_markers.csv", "-o", folder / "fitted.ply")
write_case("demo", ["bow_source.ply", "fitted.ply"])
write_case("twist_270", ["bar.obj", "bar_twisted_270.obj"])
write_case("three_keys", ["bar.obj", "bar_twisted_90.obj", "bar_twisted_270.obj"])
write_case("eased", ["bar.obj", "bar_twisted_270.obj"], ease="in-out")
