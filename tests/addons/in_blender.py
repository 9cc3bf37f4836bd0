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
scene.render.fps = 30  # glTF is imported at the scene's rate
bpy.ops.import_scene.gltf(filepath=str(folder / "x.rig.glb"))
bone = bpy.data.objects["neck"].pose.bones["head"]
frames = (0, 12, 20, 28, 36)
own = []  # how the head's own animation turns it: Blender begins it at frame 0
for frame in frames:
    scene.frame_set(frame)
    own.append(bone.matrix.to_quaternion().copy())
for data in (*bpy.data.objects, *bpy.data.shape_keys):
    data.animation_data_clear()
scene.render.fps = 24  # the take's own is 30
done = bpy.ops.import_anim.risorius_performance(filepath=str(folder / "x.arkit.csv"), head="neck:head")
rate = [scene.render.fps, scene.render.fps_base]
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
scene.render.fps = 24
bpy.ops.import_anim.risorius_performance(filepath=str(folder / "x.arkit.csv"), with_rate=False)
left_alone = scene.render.fps
scene.render.fps = 25
elsewhere = "".join(f'{name[0].lower()}{name[1:]} = "None"\n' for name in rows[0])
(folder / "map.toml").write_text(f"[shapes]\n{elsewhere}")
try:  # no shape key has the names of the map
    bpy.ops.import_anim.risorius_performance(
        filepath=str(folder / "x.arkit.csv"), names=str(folder / "map.toml")
    )
except RuntimeError as error:
    refused += str(error)
result = {
    "done": sorted(done),
    "keys": len(skin.key_blocks) - 1,
    "off": off,
    "turned": max(turned),
    "own": max(degrees(quaternion.rotation_difference(own[0]).angle) for quaternion in own),
    "sounds": [strip.name for strip in scene.sequence_editor.strips],
    "refused": refused,
    "rate": rate,
    "left alone": [left_alone, scene.render.fps],
}
risorius_performance.unregister()
Path(sys.argv[2], "result.json").write_text(json.dumps(result))
