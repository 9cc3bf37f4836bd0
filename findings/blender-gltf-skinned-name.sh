#!/bin/sh
# Blender's glTF import gives the name of a skinned node that has a child to an EMPTY, and calls the mesh object by the mesh's name, or
# NAME.001 where both names are the same. Without the child the mesh object has the node's name.
# Expected (met by chance first; that a child is what it takes was found by trying eight trees): each skinned node becomes one mesh
# object with the node's name, and the child an object below it.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check bpy==5.0.1
"$folder/venv/bin/python" - "$folder" >"$folder/log" <<'PY'
import base64
import json
import struct
import sys
from pathlib import Path

import bpy

folder = Path(sys.argv[1])


def model(mesh_name, children):
    """A triangle bound to one joint, in a node named Face with these children."""
    parts = [
        ("f", 5126, "VEC3", 3, [0, 0, 0, 1, 0, 0, 0, 1, 0]),
        ("B", 5121, "VEC4", 3, [0] * 12),
        ("f", 5126, "VEC4", 3, [1, 0, 0, 0] * 3),
        ("f", 5126, "MAT4", 1, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
    ]
    content, views, accessors = b"", [], []
    for index, (code, component, kind, count, values) in enumerate(parts):
        data = struct.pack(f"<{len(values)}{code}", *values)
        views.append({"buffer": 0, "byteOffset": len(content), "byteLength": len(data)})
        accessors.append({"bufferView": index, "componentType": component, "type": kind, "count": count})
        content += data
    accessors[0] |= {"min": [0, 0, 0], "max": [1, 1, 0]}
    nodes = [{"name": "Face", "mesh": 0, "skin": 0}, {"name": "Neck"}]
    if children:
        nodes[0]["children"] = [2]
        nodes.append({"name": "Hat"})
    attributes = {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}
    uri = "data:application/octet-stream;base64," + base64.b64encode(content).decode()
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": nodes,
        "skins": [{"joints": [1], "inverseBindMatrices": 3}],
        "meshes": [{"name": mesh_name, "primitives": [{"attributes": attributes}]}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(content), "uri": uri}],
    }


def imported(mesh_name, children):
    path = folder / "model.gltf"
    path.write_text(json.dumps(model(mesh_name, children)))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    faces = [thing for thing in bpy.data.objects if thing.name.startswith("Face")]
    return ", ".join(f"{thing.name} {thing.type}" for thing in sorted(faces, key=lambda thing: thing.name))


seen = {
    "alone": imported("FaceMesh", False),
    "with a child": imported("FaceMesh", True),
    "with a child and its mesh's name": imported("Face", True),
}
result = [
    f"version: bpy {bpy.app.version_string}",
    "behaviour: the skinned node 'Face' " + "; ".join(f"{case}: {found}" for case, found in seen.items()),
    "expected: Face MESH in each",
]
expected = ["Face MESH", "Face EMPTY, FaceMesh MESH", "Face EMPTY, Face.001 MESH"]
if list(seen.values()) != expected:
    result.append("the behaviour has changed")
(folder / "result").write_text("\n".join(result) + "\n")
PY
cat "$folder/result"
! grep -q changed "$folder/result"
