#!/bin/sh
# Blender's USD import keeps primvars:displayColor as an attribute that no material reads: a red mesh without material renders grey.
# Expected (met by chance first, so no blind guess): a mesh without material gets one that shows its displayColor.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check bpy==5.0.1
cat >"$folder/stage.usda" <<'USD'
#usda 1.0
(
    defaultPrim = "Face"
    metersPerUnit = 1
    upAxis = "Z"
)

def Mesh "Face"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-5, -5, 0), (5, -5, 0), (5, 5, 0), (-5, 5, 0)]
    color3f[] primvars:displayColor = [(1, 0, 0)] (
        interpolation = "constant"
    )
}
USD
"$folder/venv/bin/python" - "$folder" >"$folder/log" <<'PY'
import sys

import bpy

folder = sys.argv[1]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.usd_import(filepath=folder + "/stage.usda")
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.samples = 4
scene.render.resolution_x = scene.render.resolution_y = 8
scene.view_settings.view_transform = "Standard"
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location.z = 3
sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy = 1
for added in (camera, sun):
    scene.collection.objects.link(added)
scene.camera = camera
face = next(thing for thing in bpy.data.objects if thing.type == "MESH")
attribute = face.data.attributes["displayColor"]
kept = [round(value, 2) for value in attribute.data[0].color]


def pixel(name):
    scene.render.filepath = f"{folder}/{name}.png"
    bpy.ops.render.render(write_still=True)
    return [round(value, 2) for value in bpy.data.images.load(scene.render.filepath).pixels[144:147]]


materials = len(face.data.materials)
grey = pixel("imported")
material = bpy.data.materials.new("red")
reader = material.node_tree.nodes.new("ShaderNodeAttribute")
reader.attribute_name = "displayColor"
surface = material.node_tree.nodes["Principled BSDF"]
material.node_tree.links.new(reader.outputs["Color"], surface.inputs["Base Color"])
face.data.materials.append(material)
red = pixel("with_material")
result = [
    f"version: bpy {bpy.app.version_string}, Cycles",
    f"behaviour: {materials} materials; the attribute is {kept}; a pixel of the mesh is {grey}, with a material that reads it {red}",
    "expected: red without further work",
]
same = materials == 0 and grey[0] == grey[1] == grey[2] > 0 and red[0] > 2 * red[1] and kept[:3] == [1, 0, 0]
with open(folder + "/result", "w") as file:
    file.write("\n".join(result if same else [*result, "the behaviour has changed"]) + "\n")
PY
cat "$folder/result"
! grep -q changed "$folder/result"
