"""The dialled face: held values, and the skin on its way to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..core.parameters import NAMES
from ..face.frame import FaceFrame
from ..face.solve import FaceSolver
from ..face.springs import RATE, Springs
from ..pipeline import pose_values

Array = npt.NDArray[np.float64]
# Seconds after which the skin lies still, and the most that it moves on between two faces.
SETTLED, LONGEST = 0.5, 0.1


def dialled(values: Mapping[str, float], emotions: Mapping[str, float]) -> dict[str, float]:
    """Return all parameters of a face: what is dialled, and emotions on top. Raises ParameterError."""
    return dict(zip(NAMES, pose_values(values, emotions).tolist(), strict=True))


@dataclass
class Dial:
    """A face that follows its dials, on one solver; for one thread at a time."""

    solver: FaceSolver

    def __post_init__(self) -> None:
        self._springs: Springs | None = None
        self._left = 0.0

    def still(self, values: Array) -> FaceFrame:
        """Return the face at rest at `values` (46,); where the skin was is forgotten."""
        self._springs, self._left = None, 0.0
        return self.solver.solve(values)

    def moved(self, values: Array, seconds: float) -> FaceFrame:
        """Return the face after the skin has moved on for `seconds` under `values` (46,)."""
        springs = self._springs
        if springs is None:
            self._springs = springs = self.solver.springs()
            springs.settle(np.asarray(values))
        self._left += min(seconds, LONGEST) * RATE
        while self._left >= 1.0:
            springs.step(values)
            self._left -= 1.0
        share = self._left
        return self.solver.solve_moving(values, lambda skin: springs.place(share, skin))
