"""`.vrma`: VRM Animation 1.0 (VRMC_vrm_animation): head, expressions and gaze for any VRM 1.0 avatar.

A glTF without meshes. An expression's weight is the X translation of its node; gaze is a rotation of the node
`lookAt`: yaw about Y, then pitch about X. Presets come from ARKit weights by a table of ours; the 52 shapes
go along as custom expressions under their own names, for avatars that have them (Perfect Sync). Lost: what
neither can show; sound.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.arkit import SHAPES
from ...core.arrays import Array
from ...core.parameters import INDEX
from ...face.fit.expressions import expressions, preset_weights
from ...face.numerics.rotations import head_rotation
from ...reading.json_text import JsonObject
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from .gltf import Animation, Gltf, quaternions

EXTENSION, VERSION = "VRMC_vrm_animation", "1.0"
# The bones that a humanoid must have above its head, and where each stands above the one before, in metres.
BONES = {"hips": 1.0, "spine": 0.12, "chest": 0.2, "neck": 0.22, "head": 0.08}
_EYES_ABOVE_HEAD = 0.06


def write_vrma(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the animation; raise HeadError if the head has no ARKit shapes."""
    track, performance = take.fit_arkit(options.progress), take.performance
    gltf = Gltf(generator="Risorius")
    gltf.use(EXTENSION)
    bones = _bones(gltf)
    look = gltf.add("nodes", {"name": "lookAt", "translation": [0.0, _EYES_ABOVE_HEAD, 0.0]})
    gltf.document["nodes"][bones["head"]]["children"] = [look]
    presets, customs = _nodes(gltf, tuple(expressions())), _nodes(gltf, SHAPES)
    gltf.document["scene"] = gltf.add(
        "scenes", {"nodes": [bones["hips"], *presets.values(), *customs.values()]}
    )
    animation = Animation(gltf, performance.times)
    head = [head_rotation(*angles) for angles in track.head[:, [1, 0, 2]].tolist()]
    animation.drive(bones["head"], "rotation", quaternions(head))
    animation.drive(look, "rotation", quaternions(_gaze(performance.values)))
    weights = np.concatenate([preset_weights(track.weights), track.weights], axis=1)
    for node, curve in zip((*presets.values(), *customs.values()), weights.T, strict=True):
        animation.drive(node, "translation", np.stack([curve, 0 * curve, 0 * curve], axis=1))
    animation.finish()
    extension = {
        "specVersion": VERSION,
        "humanoid": {"humanBones": {name: {"node": node} for name, node in bones.items()}},
        "expressions": {"preset": _named(presets), "custom": _named(customs)},
        "lookAt": {"node": look, "offsetFromHeadBone": [0.0, _EYES_ABOVE_HEAD, 0.0]},
    }
    gltf.document["extensions"] = {EXTENSION: extension}
    gltf.save(path)


def _bones(gltf: Gltf) -> dict[str, int]:
    nodes: dict[str, int] = {}
    for name, height in BONES.items():
        parent = next(reversed(nodes.values()), None)
        nodes[name] = gltf.add("nodes", {"name": name, "translation": [0.0, height, 0.0]})
        if parent is not None:
            gltf.document["nodes"][parent]["children"] = [nodes[name]]
    return nodes


def _nodes(gltf: Gltf, names: tuple[str, ...]) -> dict[str, int]:
    return {name: gltf.add("nodes", {"name": name}) for name in names}


def _named(nodes: dict[str, int]) -> JsonObject:
    return {name: {"node": node} for name, node in nodes.items()}


def _gaze(values: Array) -> list[Array]:
    columns = [INDEX["gaze_pitch"], INDEX["gaze_yaw"]]
    return [head_rotation(pitch, yaw, 0.0) for pitch, yaw in values[:, columns].tolist()]


register(".vrma", "VRM animation: head, gaze, expressions", {"head"}, write_vrma)
