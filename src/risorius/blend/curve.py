"""What every curve of a channel can do, whether movements, lips or a hand make it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

from ..core.arrays import Array, IndexArray
from ..core.movement import LipSegment, ManualCurve, Movement
from .intervals import Extent, Spans

Origin = Movement | LipSegment | ManualCurve


class Curve(Protocol):
    """One parameter of one layer, as a deviation from its neutral."""

    def sample(self, times: Array) -> tuple[IndexArray, Array]:
        """Return where the curve is not at rest among the sorted times, and its values there."""

    def lines(self, times: Array) -> tuple[IndexArray, Array]:
        """Return the same as `sample`, but by lines between knots where that is much quicker."""

    def above(self, threshold: float) -> Spans:
        """Return when the curve is higher than `threshold`, shape (n, 2)."""

    def origin(self, time: float) -> Origin:
        """Return what stands behind the curve at a time."""

    def extents(self) -> Iterator[Extent]:
        """Yield what the curve is made of: from when to when it is in force, then all that tells it apart."""

    def breakpoints(self) -> Array:
        """Return when the curve's parts begin and end, unsorted, shape (n,)."""
