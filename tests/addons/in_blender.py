"""Started with Blender's module: imports a head and its take, and prints what differs as JSON."""

import csv
import json
import sys
from math import degrees
from pathlib import Path

import bpy

addons, folder = Path(sys.argv[1]), Path(sys.argv[2])
sys.path.insert(0, str(addons))
import risorius_performance  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
risorius_performance.register()
scene = bpy.context.scene
scene.render.fps = 30
bpy.ops.import_scene.gltf(filepath=str(folder / "x.rig.glb"))
bone = bpy.data.objects["neck"].pose.bones["head"]
frames = (0, 12, 20, 28, 36)
own = []  # how the head's own animation turns it: Blender begins it at frame 0
for frame in frames:
    scene.frame_set(frame)
    own.append(bone.matrix.to_quaternion().copy())
for data in (*bpy.data.objects, *bpy.data.shape_keys):
    data.animation_data_clear()
done = bpy.ops.import_anim.risorius_performance(filepath=str(folder / "x.arkit.csv"), head="neck:head")
rows = list(csv.DictReader((folder / "x.arkit.csv").open()))
skin = max((m.shape_keys for m in bpy.data.meshes if m.shape_keys), key=lambda keys: len(keys.key_blocks))
off, turned = 0.0, []
for frame, quaternion in zip(frames, own, strict=True):
    scene.frame_set(1 + frame)
    turned.append(degrees(bone.matrix.to_quaternion().rotation_difference(quaternion).angle))
    for key in skin.key_blocks[1:]:
        off = max(off, abs(key.value - float(rows[frame][key.name[0].upper() + key.name[1:]])))
refused = ""
try:
    bpy.ops.import_anim.risorius_performance(filepath=str(folder / "x.wav"))
except RuntimeError as error:
    refused = str(error)
result = {
    "done": sorted(done),
    "keys": len(skin.key_blocks) - 1,
    "off": off,
    "turned": max(turned),
    "own": max(degrees(quaternion.rotation_difference(own[0]).angle) for quaternion in own),
    "sounds": [strip.name for strip in scene.sequence_editor.strips],
    "refused": refused,
}
risorius_performance.unregister()
Path(sys.argv[2], "result.json").write_text(json.dumps(result))
