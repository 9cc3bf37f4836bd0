"""Started with Blender's module by `abroad.py`: imports a file and writes what it shows, frame by frame.

Asked by JSON on the standard input, it writes a row of float32 for each frame: the wanted vertices of the
skin in metres, the head's quaternion (x, y, z, w), the directions of both eyes; with Y up, as in our files.
"""

from __future__ import annotations

import json
import sys

import bpy
import numpy as np
from mathutils import Matrix, Vector

RATE = 30  # frames per second of the takes; Blender puts keys of glTF at times, those of USD at frames
FORWARD = Vector((0.0, -1.0, 0.0))
Y_UP = Matrix(((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)))


def turn(armature, name: str) -> Matrix:
    """Return how a bone is turned in the world from its rest."""
    bone = armature.pose.bones[name]
    world = armature.matrix_world.to_3x3()
    return world @ bone.matrix.to_3x3() @ bone.bone.matrix_local.to_3x3().inverted() @ world.inverted()


def look(armature, name: str) -> Vector:
    """Return an eye's direction: that of a bone (USD), or of an object (glTF)."""
    if name in armature.pose.bones:
        return turn(armature, name) @ FORWARD
    return bpy.data.objects[name].matrix_world.to_3x3().normalized() @ FORWARD


def row(wanted) -> np.ndarray:
    """Return what the current frame shows."""
    graph = bpy.context.evaluated_depsgraph_get()
    # Of glTF it imports an empty object that has the node's name, too.
    meshes = (item for item in bpy.data.objects if item.type == "MESH" and item.name.startswith("skin"))
    skin = next(meshes).evaluated_get(graph)
    mesh = skin.to_mesh()
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    world = np.array(Y_UP @ skin.matrix_world.to_3x3())
    places = points.reshape(-1, 3)[wanted] @ world.T
    skin.to_mesh_clear()
    (armature,) = (item for item in bpy.data.objects if item.type == "ARMATURE")
    w, x, y, z = (Y_UP @ turn(armature, "head") @ Y_UP.inverted()).to_quaternion()
    eyes = [Y_UP @ look(armature, name) for name in ("eye_left", "eye_right")]
    return np.concatenate([places.ravel(), [x, y, z, w], *eyes]).astype(np.float32)


asked = json.load(sys.stdin)
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = RATE
if asked["file"].endswith(".usda"):
    bpy.ops.wm.usd_import(filepath=asked["file"])
else:
    bpy.ops.import_scene.gltf(filepath=asked["file"])
last = round(max(action.frame_range[1] for action in bpy.data.actions or ()) if bpy.data.actions else 0)
last = max(last, bpy.context.scene.frame_end if asked["file"].endswith(".usda") else 0)
rows = []
for frame in range(last + 1):
    bpy.context.scene.frame_set(frame)
    rows.append(row(asked["wanted"]))
np.array(rows).tofile(asked["out"])
