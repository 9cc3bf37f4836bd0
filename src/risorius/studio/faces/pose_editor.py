"""The dialled face: held values, and the skin on its way to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array
from ...core.parameters import INDEX, NAMES, NEUTRAL, PARAMETERS
from ...face.frame import FaceFrame
from ...face.skin.springs import RATE, Springs
from ...face.solve import FaceSolver
from ...rules.poses import pose_values

# Seconds after which the skin lies still, and the most that it moves on between two faces.
SETTLED, LONGEST = 0.6, 0.1
# Seconds in which a dial turned all the way is followed, as by a quick muscle: the skin would tear at a jump.
FULL_WAY = 0.1
_STEP = np.array([p.high - p.low for p in PARAMETERS]) / (FULL_WAY * RATE)
# A distance has no way to go: the eyes go there at once.
_STEP[INDEX["gaze_distance"]] = np.inf


def dialled(values: Mapping[str, float], emotions: Mapping[str, float]) -> dict[str, float]:
    """Return all parameters of a face: the chosen values, and emotions on top. Raises ParameterError."""
    return dict(zip(NAMES, pose_values(values, emotions).tolist(), strict=True))


@dataclass
class PoseEditor:
    """A face that follows its dials, on one solver; for one thread at a time."""

    solver: FaceSolver

    def __post_init__(self) -> None:
        self._springs: Springs | None = None
        self._now = NEUTRAL.copy()
        self._left = 0.0

    def still(self, values: Array) -> FaceFrame:
        """Return the face at rest at `values` (46,)."""
        self._now = np.array(values)
        self._left = 0.0
        if self._springs is not None:
            self._springs.come_to_rest(self._now)
        return self.solver.solve(values)

    def moved(self, values: Array, seconds: float) -> FaceFrame:
        """Return the face after it has gone on for `seconds` towards `values` (46,), the skin with it."""
        springs = self._springs
        if springs is None:
            self._springs = springs = self.solver.springs()
            springs.come_to_rest(self._now)
        self._left += min(seconds, LONGEST) * RATE
        while self._left >= 1.0:
            self._now = self._now + np.clip(values - self._now, -_STEP, _STEP)
            springs.step(self._now)
            self._left -= 1.0
        return self.solver.solve_moving(self._now, springs, 1.0)
