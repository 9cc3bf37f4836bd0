"""Curves drawn by hand: keys joined by straight lines, in force only within their own time."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..core.movement import ManualCurve
from .concatenate import NEUTRALS
from .intervals import Array, Indices, Spans, above_line


class KeyCurve:
    """One parameter's keys in a curve drawn by hand, as deviations from its neutral."""

    def __init__(self, name: str, drawn: ManualCurve) -> None:
        table = np.array(drawn.keys[name], dtype=np.float64)
        self.times, self.values = table[:, 0].copy(), table[:, 1] - NEUTRALS[name]
        self._drawn = drawn

    def sample(self, times: Array) -> tuple[Indices, Array]:
        """Return where the curve is in force and its values there (see StrokeCurve.sample)."""
        low = np.searchsorted(times, self.times[0], side="left")
        high = np.searchsorted(times, self.times[-1], side="right")
        index = np.arange(low, high)
        return index, np.interp(times[index], self.times, self.values)

    lines = sample

    def above(self, threshold: float) -> Spans:
        """Return when the curve is higher than `threshold`, shape (n, 2)."""
        return above_line(self.times, self.values, threshold)

    def origin(self, time: float) -> ManualCurve:
        """Return the curve as it was drawn."""
        return self._drawn

    def breakpoints(self) -> Array:
        """Return the key times, shape (n,)."""
        return self.times


def key_curves(curves: Iterable[ManualCurve]) -> dict[str, list[KeyCurve]]:
    """Return for each parameter all curves drawn for it."""
    found: dict[str, list[KeyCurve]] = {}
    for curve in curves:
        for name in curve.keys:
            found.setdefault(name, []).append(KeyCurve(name, curve))
    return found
