"""From muscles back to action units: the non-negative least squares over the table of units."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import nnls

from ...core.action_units import ACTION_UNITS
from ...core.arrays import Array
from ...core.parameters import BASES, INDEX, MUSCLES

_BASES = tuple(dict.fromkeys(muscle.base for muscle in MUSCLES))
# For several units with the same muscles, the fit prefers the smallest sum of intensities.
_RIDGE = 0.02


class ActionUnitFit:
    """Finds intensities 0..1 of action units `numbers` for curves of muscles; sides are averaged."""

    def __init__(self, numbers: Sequence[int]) -> None:
        self.numbers = tuple(numbers)
        units = [ACTION_UNITS[number] for number in numbers]
        self._matrix = np.array([[unit.weights.get(base, 0.0) for unit in units] for base in _BASES])
        self._regularized = np.vstack([self._matrix, _RIDGE * np.ones(len(units))])

    def intensities(self, values: Array) -> Array:
        """Return (frames, units) for values (frames, 46) in the parameter table's order."""
        columns = [[INDEX[p.name] for p in BASES[base]] for base in _BASES]
        muscles = np.stack([values[:, sides].mean(axis=1) for sides in columns], axis=1)
        intensities = [nnls(self._regularized, np.append(row, 0.0))[0] for row in muscles]
        return np.asarray(np.minimum(np.reshape(intensities, (len(values), -1)), 1.0))
