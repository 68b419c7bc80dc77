#!/usr/bin/env python3
"""How many meshes play a path, and how large the GLB is: glb_sizes.py PROGRAM NAME=SOURCE,TARGET ...

Prints the rows of the table in docs/path.md; each target is a mesh with the source's vertices."""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

program = sys.argv[1]
print("| path | meshes | in a frame | GLB, MB | off by at most |\n|---|---|---|---|---|")
for argument in sys.argv[2:]:
    name, pair = argument.split("=", 1)
    with tempfile.TemporaryDirectory() as folder:
        glb, report = Path(folder, "morph.glb"), Path(folder, "report.json")
        subprocess.run([program, "tween", *pair.split(","), "--no-repair", "-o", glb, "--report", report, "--quiet"], check=True)
        curve = json.loads(report.read_text())["path"]["curve"]
        frame = curve["degree"] + 1 if "degree" in curve else curve["meshes"]
        print(f"| {name} | {curve['meshes']} | {frame} | {glb.stat().st_size / 1e6:.2f} | {curve['deviation']:.1e} |")
