"""Displacements of MPEG-4's feature points on a face, as animation parameters (ISO/IEC 14496-2, Annex C).

Units (FAPU) are distances on the neutral face, each divided by 1024; angles are in 1e-5 rad.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array, FloatArray, Int32Array
from ...core.parameters import INDEX, NEUTRAL
from ..frame import FaceFrame
from ..head.eyes import pitch_and_yaw
from ..head.head import Head
from ..muscles.jaw import Jaw
from ..muscles.tongue import TongueShapes

COUNT = 68
ANGLE = 1e-5
IRIS_SHARE = 0.73  # the iris' diameter in radii of the eyeball (11.7 mm on 24 mm; Forrester, The Eye)
_LEFT, _UP, _FORWARD = np.eye(3)

# number: (iBUG point, direction in which it is positive, unit)
POINTS: dict[int, tuple[int, Array, str]] = {
    3: (8, -_UP, "MNS"),
    4: (62, -_UP, "MNS"),
    5: (66, _UP, "MNS"),
    6: (64, _LEFT, "MW"),
    7: (60, -_LEFT, "MW"),
    8: (63, -_UP, "MNS"),
    9: (61, -_UP, "MNS"),
    10: (65, _UP, "MNS"),
    11: (67, _UP, "MNS"),
    12: (64, _UP, "MNS"),
    13: (60, _UP, "MNS"),
    14: (8, _FORWARD, "MNS"),
    15: (8, -_LEFT, "MW"),
    16: (66, _FORWARD, "MNS"),
    17: (62, _FORWARD, "MNS"),
    31: (22, _UP, "ENS"),
    32: (21, _UP, "ENS"),
    33: (24, _UP, "ENS"),
    34: (19, _UP, "ENS"),
    35: (26, _UP, "ENS"),
    36: (17, _UP, "ENS"),
    37: (22, -_LEFT, "ES"),
    38: (21, _LEFT, "ES"),
    51: (51, -_UP, "MNS"),
    52: (57, _UP, "MNS"),
    53: (54, _LEFT, "MW"),
    54: (48, -_LEFT, "MW"),
    55: (52, -_UP, "MNS"),
    56: (50, -_UP, "MNS"),
    57: (56, _UP, "MNS"),
    58: (58, _UP, "MNS"),
    59: (54, _UP, "MNS"),
    60: (48, _UP, "MNS"),
    61: (35, _LEFT, "ENS"),
    62: (31, -_LEFT, "ENS"),
    63: (33, _UP, "ENS"),
}
LIDS = {19: (0, 0, -1.0), 20: (1, 0, -1.0), 21: (0, 1, 1.0), 22: (1, 1, 1.0)}
"""number: (eye, 0 for the upper and 1 for the lower lid, sign of up)"""
ANGLES = {23: "yaw_left", 24: "yaw_right", 25: "pitch_left", 26: "pitch_right", 48: "", 49: "", 50: ""}
TONGUE = {44: _UP, 45: _FORWARD}
SHOWN = tuple(sorted((*POINTS, *LIDS, *ANGLES, *TONGUE)))
"""The parameters that our faces set; the others are masked out."""


@dataclass(frozen=True, slots=True)
class Fapu:
    """The units in mm: iris diameter, eye separation, eye to nose, mouth to nose, mouth width, over 1024."""

    IRISD: float
    ES: float
    ENS: float
    MNS: float
    MW: float


class FeaturePoints:
    """Measures animation parameters on the frames of one head."""

    def __init__(self, head: Head) -> None:
        self._head = head
        rest = head.skin.matrix @ head.rest
        self._rest = head.landmarks(rest)
        self._lids = [_middle(pairs, rest) for pairs in head.lid_pairs]
        self._rest_lids = [rest[pairs].mean(axis=0) for pairs in self._lids]
        self._tongue, self._jaw = TongueShapes.of(head), Jaw.of(head)
        tongue = self._tongue.place(NEUTRAL, self._jaw, 0.0)
        self._tip = int(tongue[:, 2].argmax())
        self.units = self._measure_units()

    def values(self, frame: FaceFrame) -> Array:
        """Return the 68 parameters in FAP units, 0 for those that our faces do not set; index 0 is FAP 1."""
        parameters = self.of_skin(frame.skin)
        eyes = [pitch_and_yaw(rotation) for rotation in frame.eye_rotation]
        for side, (pitch, yaw) in enumerate(eyes):
            parameters[22 + side], parameters[24 + side] = np.radians(yaw) / ANGLE, -np.radians(pitch) / ANGLE
        pitch, yaw, roll = (frame.parameters[INDEX[f"head_{axis}"]] for axis in ("pitch", "yaw", "roll"))
        parameters[47:50] = np.radians([-pitch, yaw, -roll]) / ANGLE
        parameters[[number - 1 for number in TONGUE]] = self.tongue_tip(frame)
        return parameters

    def of_skin(self, skin: FloatArray) -> Array:
        """Return the parameters (68,) of points and lids for a level-1 skin (N1, 3) mm, 0 elsewhere."""
        moved = self._head.landmarks(skin) - self._rest
        parameters = np.zeros(COUNT)
        for number, (point, direction, unit) in POINTS.items():
            parameters[number - 1] = moved[point] @ direction / getattr(self.units, unit)
        for number, (eye, lid, sign) in LIDS.items():
            now = np.asarray(skin, np.float64)[self._lids[eye]].mean(axis=0)
            parameters[number - 1] = sign * (now - self._rest_lids[eye])[lid, 1] / self.units.IRISD
        return parameters

    def sizes(self) -> Array:
        """Return the unit of each parameter (68,) in mm, 0 for those that do not move a point."""
        parameters = np.zeros(COUNT)
        for number, (_, _, unit) in POINTS.items():
            parameters[number - 1] = getattr(self.units, unit)
        parameters[[number - 1 for number in LIDS]] = self.units.IRISD
        return parameters

    def tongue_tip(self, frame: FaceFrame) -> Array:
        """Return height and thrust of the tip relative to the jaw (2,): the parameters of `TONGUE`."""
        carried = self._tongue.place(NEUTRAL, self._jaw, frame.jaw_angle / self._jaw.angle)[self._tip]
        way = frame.tongue[self._tip].astype(np.float64) - carried
        return np.array([way[1] / self.units.MNS, way[2] / self.units.MW])

    def _measure_units(self) -> Fapu:
        points, head = self._rest, self._head
        eye = float(head.eye_centre[:, 1].mean())
        mouth = float(points[[62, 66], 1].mean())
        iris = IRIS_SHARE * float(head.eye_radius.mean())
        lengths = (
            iris,
            float(np.linalg.norm(head.eye_centre[0] - head.eye_centre[1])),
            eye - points[33, 1],
            points[33, 1] - mouth,
            float(np.linalg.norm(points[54] - points[48])),
        )
        return Fapu(*(float(length) / 1024.0 for length in lengths))


def _middle(pairs: Int32Array, rest: Array) -> Int32Array:
    """Return the lid pairs (k, 2) over the middle of the eye: those whose opening at rest is widest."""
    opening = np.linalg.norm(rest[pairs[:, 0]] - rest[pairs[:, 1]], axis=1)
    return np.asarray(pairs[opening > 0.9 * opening.max()])
