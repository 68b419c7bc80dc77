"""What Blender shows of the files of played_files.py: blender -b --factory-startup --python-exit-code 1 --python blender.py -- FOLDER"""
import json
import sys
from pathlib import Path

import numpy

numpy.bool = bool  # the glTF importer of Blender 3.4 still asks for it
import bpy  # noqa: E402

folder = Path(sys.argv[sys.argv.index("--") + 1])


def shape_now(found):
    """The evaluated vertices in the file's coordinates, in which y points up."""
    evaluated = found.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    flat = numpy.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", flat)
    world = numpy.array(found.matrix_world)
    points = flat.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    evaluated.to_mesh_clear()
    return numpy.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1)


def checked(name):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(folder / f"{name}.glb"))
    found = next(o for o in bpy.context.scene.objects if o.type == "MESH")
    curves = found.data.shape_keys.animation_data.action.fcurves
    values = [point.co[1] for curve in curves for point in curve.keyframe_points]
    assert min(values) >= 0 and max(values) <= 1, (min(values), max(values))
    case = json.loads((folder / f"{name}.json").read_text())
    rate = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
    shapes = [numpy.array(m["vertices"]).reshape(-1, 3) for m in case["moments"]]
    diagonal = numpy.linalg.norm(shapes[0].max(axis=0) - shapes[0].min(axis=0))
    worst = 0
    for moment, wanted in zip(case["moments"], shapes):
        frame = moment["t"] * case["seconds"] * rate
        bpy.context.scene.frame_set(int(frame), subframe=frame - int(frame))
        off = numpy.linalg.norm(shape_now(found)[: len(wanted)] - wanted, axis=1).max() / diagonal
        print(f"{name} at {moment['t']}: {off:.1e} of the diagonal")
        worst = max(worst, off)
    assert worst <= case["tolerance"], f"{name} is {worst} of the diagonal off in Blender"


print("Blender", bpy.app.version_string)
for file in sorted(folder.glob("*.glb")):
    checked(file.stem)
print("all as tween --at")
