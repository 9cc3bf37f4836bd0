"""The ARKit weights that follow directly from a frame without a fit: the eyes' directions and the tongue."""

from __future__ import annotations

import numpy as np

from ...core.arkit import INDEX, SHAPES
from ...core.arrays import Array
from ...core.parameters import INDEX as PARAMETER
from ...core.parameters import PARAMETERS
from ..frame import FaceFrame
from ..head.eyes import pitch_and_yaw

DIRECT = np.array([name.startswith("eyeLook") or name == "tongueOut" for name in SHAPES])
"""Mask (52,) of the shapes that follow directly from a frame."""

_PITCH, _YAW = (PARAMETERS[PARAMETER[name]].high for name in ("gaze_pitch", "gaze_yaw"))
_SIDES = (("Left", 1.0), ("Right", -1.0))


def direct_weights(frame: FaceFrame) -> Array:
    """Return the weights (52,) of the eyes' directions and of the tongue, 0 for all others."""
    result = np.zeros(len(SHAPES))
    for (side, outwards), rotation in zip(_SIDES, frame.eye_rotation, strict=True):
        pitch, yaw = pitch_and_yaw(rotation)
        for name, share in (
            ("Up", pitch / _PITCH),
            ("Down", -pitch / _PITCH),
            ("Out", outwards * yaw / _YAW),
            ("In", -outwards * yaw / _YAW),
        ):
            result[INDEX[f"eyeLook{name}{side}"]] = min(max(share, 0.0), 1.0)
    result[INDEX["tongueOut"]] = frame.parameters[PARAMETER["tongue_out"]]
    return result


def gaze_of(weights: Array) -> tuple[Array, Array]:
    """Return pitch and yaw (n,) of the gaze in degrees from weights (n, 52): the mean of both eyes."""

    def of(name: str) -> Array:
        return np.asarray(weights[:, INDEX[f"eyeLook{name}"]])

    pitch = 0.5 * _PITCH * sum(of(f"Up{side}") - of(f"Down{side}") for side, _ in _SIDES)
    yaw = 0.5 * _YAW * sum(sign * (of(f"Out{side}") - of(f"In{side}")) for side, sign in _SIDES)
    return np.asarray(pitch), np.asarray(yaw)
