"""The interface of a channel's curves, whether movements, lips or a hand shape them."""

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
        """Return at which of the sorted times the curve is not at rest, and its values at them."""

    def lines(self, times: Array) -> tuple[IndexArray, Array]:
        """Return the values of `sample`, by straight lines between knots if that is much faster."""

    def above(self, threshold: float) -> Spans:
        """Return when the curve is higher than `threshold`, shape (n, 2)."""

    def origin(self, time: float) -> Origin:
        """Return the movement, segment or drawn curve that moves the curve at a time."""

    def extents(self) -> Iterator[Extent]:
        """Yield the extent of each part of the curve."""

    def breakpoints(self) -> Array:
        """Return when the curve's parts begin and end, unsorted, shape (n,)."""
