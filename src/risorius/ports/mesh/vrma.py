"""`.vrma`: VRM Animation 1.0 (VRMC_vrm_animation): head, expressions and gaze for any VRM 1.0 avatar.

A glTF without meshes. An expression's weight is the X translation of its node; gaze is a rotation of the node
`lookAt`: yaw about Y, then pitch about X. The option `names` chooses the expressions: VRM's presets by a
table of ours, or the 52 shapes under their own names as custom expressions, for avatars that have them
(Perfect Sync). One file never has both: avatars whose presets are made of the shapes would add them up. Lost:
what the chosen set cannot show; sound.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ...core.arkit import SHAPES, column_of
from ...core.arrays import Array
from ...core.lips.closed_lips import shut_lips
from ...core.parameters import INDEX
from ...face.fit.expressions import emotion_weights, expressions, preset_weights
from ...face.numerics.rotations import head_rotation
from ...reading.json_text import JsonObject
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from .gltf import Animation, Gltf, clip_times, quaternions

EXTENSION, VERSION = "VRMC_vrm_animation", "1.0"
# The bones that a humanoid must have above its head, and where each stands above the one before, in metres.
BONES = {"hips": 1.0, "spine": 0.12, "chest": 0.2, "neck": 0.22, "head": 0.08}
_EYES_ABOVE_HEAD = 0.06
# VRM 0 lacks this preset: its avatars have a custom expression instead, which loaders do not rename.
_ONLY_VRM1 = "surprised"


def write_vrma(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the animation; raise HeadError if the head has no ARKit shapes."""
    track, performance = take.fit_arkit(options.progress), take.performance
    gltf = Gltf(generator="Risorius")
    gltf.use(EXTENSION)
    bones = _bones(gltf)
    look = gltf.add("nodes", {"name": "lookAt", "translation": [0.0, _EYES_ABOVE_HEAD, 0.0]})
    gltf.document["nodes"][bones["head"]]["children"] = [look]
    if options.names in ("arkit", "ARKit"):
        kinds, curves = _shape_kinds(options.names), track.weights
    else:
        kinds, curves = _preset_kinds(options.names), _preset_curves(take, track.weights)
    nodes = {name: gltf.add("nodes", {"name": name}) for name in kinds}
    gltf.document["scene"] = gltf.add("scenes", {"nodes": [bones["hips"], *nodes.values()]})
    animation = Animation(gltf, clip_times(take))
    head = [head_rotation(*angles) for angles in track.head[:, [1, 0, 2]].tolist()]
    animation.drive(bones["head"], "rotation", quaternions(head))
    animation.drive(look, "rotation", quaternions(_gaze(performance.values)))
    for node, curve in zip(nodes.values(), curves.T, strict=True):
        animation.drive(node, "translation", np.stack([curve, 0 * curve, 0 * curve], axis=1))
    animation.finish()
    extension = {
        "specVersion": VERSION,
        "humanoid": {"humanBones": {name: {"node": node} for name, node in bones.items()}},
        "expressions": _named(nodes, kinds),
        "lookAt": {"node": look, "offsetFromHeadBone": [0.0, _EYES_ABOVE_HEAD, 0.0]},
    }
    gltf.document["extensions"] = {EXTENSION: extension}
    gltf.save(path)


def _shape_kinds(names: str) -> dict[str, str]:
    """Return the kind of expression ("preset" or "custom") by name: the 52 shapes."""
    return dict.fromkeys(SHAPES if names == "arkit" else map(column_of, SHAPES), "custom")


def _preset_kinds(names: str) -> dict[str, str]:
    """Return the kind of expression by name: VRM's presets, for avatars of VRM 1 or of VRM 0."""
    kinds = dict.fromkeys(expressions(), "preset")
    if names == "vrm1":
        return kinds
    custom = {_ONLY_VRM1: (expressions()[_ONLY_VRM1].vrm0, "custom")}
    return dict(custom.get(name, (name, kind)) for name, kind in kinds.items())


def _preset_curves(take: WritableTake, weights: Array) -> Array:
    shut = shut_lips(take.head_lips, take.performance.values)
    return preset_weights(weights, shut, emotion_weights(take.emotion_curves()))


def _bones(gltf: Gltf) -> dict[str, int]:
    nodes: dict[str, int] = {}
    for name, height in BONES.items():
        parent = next(reversed(nodes.values()), None)
        nodes[name] = gltf.add("nodes", {"name": name, "translation": [0.0, height, 0.0]})
        if parent is not None:
            gltf.document["nodes"][parent]["children"] = [nodes[name]]
    return nodes


def _named(nodes: Mapping[str, int], kinds: Mapping[str, str]) -> JsonObject:
    """Return the extension's expressions, by kind and name."""
    by_kind: dict[str, JsonObject] = {}
    for name, node in nodes.items():
        by_kind.setdefault(kinds[name], {})[name] = {"node": node}
    return by_kind


def _gaze(values: Array) -> list[Array]:
    columns = [INDEX["gaze_pitch"], INDEX["gaze_yaw"]]
    return [head_rotation(pitch, yaw, 0.0) for pitch, yaw in values[:, columns].tolist()]


register(".vrma", "VRM animation: head, gaze, expressions", {"head"}, write_vrma, reads=("names",))
