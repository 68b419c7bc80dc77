"""What Pixar's USD shows of the files of played_files.py: usd.py FOLDER ENVIRONMENT.

UsdSkel evaluates blend shapes at some moments, and bakes them, which must give what `tween --at` gives. Without the
package usd-core it is fetched into ENVIRONMENT; where that fails the test ends with 77, skipped.
"""
import json
import subprocess
import sys
import venv
from pathlib import Path

folder, environment = Path(sys.argv[1]), Path(sys.argv[2])
SKIPPED = 77

try:
    from pxr import Gf, Usd, UsdGeom, UsdSkel, Vt
except ImportError:
    python = environment / "bin" / "python"
    if Path(sys.executable).parent == python.parent:
        raise
    try:
        if not python.exists():
            venv.create(environment, with_pip=True, clear=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "usd-core", "numpy"], check=True, timeout=600)
    except Exception as problem:  # no venv, no network, no package for this machine
        print(f"skipped: usd-core, Pixar's reader of USD, cannot be had from PyPI: {problem}")
        sys.exit(SKIPPED)
    sys.exit(subprocess.run([python, __file__, *sys.argv[1:]]).returncode)

import numpy  # noqa: E402


def evaluated(stage, time):
    """The points that blend shapes and their weights give at a time, in the world."""
    surface, skeleton = stage.GetPrimAtPath("/Model/Surface"), stage.GetPrimAtPath("/Model/Skeleton")
    cache = UsdSkel.Cache()
    cache.Populate(UsdSkel.Root(stage.GetPrimAtPath("/Model")), Usd.PrimDefaultPredicate)
    weights = cache.GetSkelQuery(UsdSkel.Skeleton(skeleton)).GetAnimQuery().ComputeBlendShapeWeights(time)
    assert all(0 <= weight <= 1 for weight in weights), weights
    shapes = UsdSkel.BlendShapeQuery(UsdSkel.BindingAPI(surface))
    parts = shapes.ComputeSubShapeWeights(weights)
    points = Vt.Vec3fArray(UsdGeom.Mesh(surface).GetPointsAttr().Get())
    assert shapes.ComputeDeformedPoints(*parts, shapes.ComputeBlendShapePointIndices(), shapes.ComputeSubShapePointOffsets(), points)
    place = numpy.array(UsdGeom.Xformable(surface).ComputeLocalToWorldTransform(time))
    return numpy.array(points, dtype=float) @ place[:3, :3] + place[3, :3]


def checked(name):
    case = json.loads((folder / f"{name}.json").read_text())
    stage = Usd.Stage.Open(str(folder / f"{name}.usda"))
    rate = stage.GetTimeCodesPerSecond()
    shapes = [numpy.array(moment["vertices"]).reshape(-1, 3) for moment in case["moments"]]
    diagonal = numpy.linalg.norm(shapes[0].max(axis=0) - shapes[0].min(axis=0))
    worst = 0
    for moment, wanted in zip(case["moments"], shapes):
        found = evaluated(stage, moment["t"] * case["seconds"] * rate)
        off = numpy.linalg.norm(found - wanted, axis=1).max() / diagonal
        print(f"{name} at {moment['t']}: {off:.1e} of the diagonal")
        worst = max(worst, off)
    assert worst <= case["tolerance"], f"{name} is {worst} of the diagonal off in USD"
    # Baked by UsdSkel itself, points and normals: at the end, a whole time code.
    last = case["seconds"] * rate
    assert UsdSkel.BakeSkinning(UsdSkel.Root(stage.GetPrimAtPath("/Model")), Gf.Interval(0, last))
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/Model/Surface"))
    place = numpy.array(UsdGeom.Xformable(mesh).ComputeLocalToWorldTransform(last))
    baked = numpy.array(mesh.GetPointsAttr().Get(last), dtype=float) @ place[:3, :3] + place[3, :3]
    assert numpy.linalg.norm(baked - shapes[-1], axis=1).max() / diagonal <= case["tolerance"]
    normals = numpy.array(mesh.GetNormalsAttr().Get(last))
    faces = numpy.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)  # these files hold triangles
    across = numpy.cross(baked[faces[:, 1]] - baked[faces[:, 0]], baked[faces[:, 2]] - baked[faces[:, 0]])
    agree = (across[:, None, :] * normals[faces]).sum(axis=2) > 0
    assert agree.mean() > 0.95, f"normals of {name} agree with {agree.mean():.0%} of the corners"


print("USD", Usd.GetVersion())
files = sorted(folder.glob("*.usda"))
assert files, "no files to look at"
for file in files:
    checked(file.stem)
print("all as tween --at")
