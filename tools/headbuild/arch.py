"""The dental arch: a parabola in a plane of constant height, walked by its length."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from risorius.core.arrays import AnyArray


@dataclass(frozen=True)
class Arch:
    """z = front - bend * x², mm; positions along it are lengths from the midline, positive to the
    subject's left.
    """

    front: float
    bend: float

    @cached_property
    def _table(self) -> tuple[AnyArray, AnyArray]:
        x = np.linspace(0.0, 40.0, 2001)
        step = np.hypot(np.diff(x), np.diff(self.bend * x**2))
        return x, np.concatenate([[0.0], np.cumsum(step)])

    def place(self, along: AnyArray, outward: AnyArray) -> tuple[AnyArray, AnyArray]:
        """x and z (n,) of points `along` the arch and `outward` of it (mm)."""
        at, length = self._table
        x = np.sign(along) * np.interp(np.abs(along), length, at)
        slope = 2.0 * self.bend * x
        size = np.hypot(slope, 1.0)
        return x + outward * slope / size, self.front - self.bend * x**2 + outward / size
