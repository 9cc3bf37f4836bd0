"""VMC: the Virtual Motion Capture protocol (sh-akira, specification 3.1), OSC messages over UDP.

Each frame: time, the bones `Head`, `LeftEye` and `RightEye`, the expressions, and the message that applies
them. Rotations are Unity's: left-handed, so x points to the subject's right. Lost: all but these; over VRM's
presets also most of the face.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from ...core.arkit import SHAPES, column_of
from ...core.arrays import Array
from ...face.fit.expressions import expressions, preset_weights
from ...face.numerics.rotations import head_rotation
from ...ports.mesh.gltf import quaternion
from .osc import bundles, message
from .protocols import ArkitMoment, Options, Packets

BONES = ("Head", "LeftEye", "RightEye")


def vmc_packets(fps: Fraction, options: Options) -> Packets:
    """Return the bundles of a frame, each small enough for one datagram."""
    names = _expressions(options.names)

    def packets(frame: ArkitMoment) -> list[bytes]:
        parts = [message("/VMC/Ext/OK", 1), message("/VMC/Ext/T", float(frame.index / fps))]
        for bone, angles in zip(BONES, (frame.head, *frame.eyes), strict=True):
            turn = unity_quaternion(angles)
            parts.append(message("/VMC/Ext/Bone/Pos", bone, 0.0, 0.0, 0.0, *turn.tolist()))
        weights = frame.weights if len(names) == len(SHAPES) else _presets(frame)
        for name, weight in zip(names, weights, strict=True):
            parts.append(message("/VMC/Ext/Blend/Val", name, float(weight)))
        return bundles([*parts, message("/VMC/Ext/Blend/Apply")])

    return packets


def unity_quaternion(angles: Array) -> Array:
    """Return (x, y, z, w) in Unity's axes of yaw, pitch and roll (3,) in degrees."""
    yaw, pitch, roll = (float(angle) for angle in angles)
    x, y, z, w = quaternion(head_rotation(pitch, yaw, roll))
    return np.array([x, -y, -z, w])


def _presets(frame: ArkitMoment) -> Array:
    emotion = None if frame.emotion is None else frame.emotion[None]
    return np.asarray(preset_weights(frame.weights[None], np.array([frame.shut]), emotion)[0])


def _expressions(names: str) -> Sequence[str]:
    if names == "arkit":
        return SHAPES
    if names == "ARKit":
        return [column_of(name) for name in SHAPES]
    if names == "vrm1":
        return list(expressions())
    return [expression.vrm0 for expression in expressions().values()]
