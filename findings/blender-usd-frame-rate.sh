#!/bin/sh
# Blender's USD import keeps the scene at 24 frames per second where the stage says framesPerSecond = 30 and timeCodesPerSecond = 30:
# one second lasts 1.25 s.
# Expected (met by chance first, so no blind guess): framesPerSecond sets the scene's rate.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check bpy==5.0.1
cat >"$folder/stage.usda" <<'USD'
#usda 1.0
(
    defaultPrim = "Face"
    endTimeCode = 30
    framesPerSecond = 30
    metersPerUnit = 1
    startTimeCode = 0
    timeCodesPerSecond = 30
    upAxis = "Z"
)

def Xform "Face"
{
    double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 30: (0, 0, 1) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
USD
"$folder/venv/bin/python" - "$folder" <<'PY'
import sys

import bpy

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.usd_import(filepath=sys.argv[1] + "/stage.usda")
scene = bpy.context.scene
rate = scene.render.fps / scene.render.fps_base
frames = scene.frame_end - scene.frame_start
print("version: bpy", bpy.app.version_string)
print(f"behaviour: {frames} frames at {rate:g} per second, {frames / rate:g} s, of 30 time codes at 30 per second")
print("expected: 30 frames at 30 per second, 1 s")
sys.exit(0 if (rate, frames) == (24, 30) else "the behaviour has changed")
PY
