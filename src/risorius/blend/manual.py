"""Curves drawn by hand: keys joined by lines, in force only within their own time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from ..core.arrays import Array, IndexArray
from ..core.key_shapes import polyline
from ..core.movement import ManualCurve
from ..core.parameters import INDEX, PARAMETERS
from .concatenate import NEUTRALS
from .curve import Curve, Origin
from .intervals import Extent, Spans, above_line, covers, difference, merged


class KeyCurve:
    """One parameter's keys in a curve drawn by hand, as deviations from its neutral."""

    def __init__(self, name: str, drawn: ManualCurve) -> None:
        table = polyline(drawn.keys[name], drawn.shapes.get(name, ()))
        parameter = PARAMETERS[INDEX[name]]
        # Handles may reach beyond the range.
        values = np.clip(table[:, 1], parameter.low, parameter.high) if drawn.shapes else table[:, 1]
        self.times, self.values = table[:, 0].copy(), values - NEUTRALS[name]
        self._keys = np.array([time for time, _ in drawn.keys[name]])
        self._drawn = drawn

    def sample(self, times: Array) -> tuple[IndexArray, Array]:
        """Return the times at which the curve is in force, and its values (see MovementCurve.sample)."""
        low = np.searchsorted(times, self.times[0], side="left")
        high = np.searchsorted(times, self.times[-1], side="right")
        index = np.arange(low, high)
        return index, np.interp(times[index], self.times, self.values)

    lines = sample

    def above(self, threshold: float) -> Spans:
        """Return when the curve is higher than `threshold`, shape (n, 2)."""
        return above_line(self.times, self.values, threshold)

    @property
    def replaces(self) -> bool:
        """Whether the curve stands in place of those of all other channels."""
        return self._drawn.replaces

    def origin(self, time: float) -> ManualCurve:
        """Return the drawn curve."""
        return self._drawn

    def extents(self) -> Iterator[Extent]:
        """Yield the whole curve as one extent."""
        yield float(self.times[0]), float(self.times[-1]), (self.times.tobytes(), self.values.tobytes())

    def breakpoints(self) -> Array:
        """Return the key times, shape (n,)."""
        return self._keys


def drawn_layers(curves: Iterable[ManualCurve]) -> list[dict[str, KeyCurve]]:
    """Return the curve of each parameter in each of some drawn curves."""
    return [{name: KeyCurve(name, curve) for name in curve.keys} for curve in curves]


class ManualOverride:
    """Another channel's curve, at rest while a curve drawn by hand replaces it."""

    def __init__(self, curve: Curve, spans: Spans) -> None:
        self.curve, self._spans = curve, spans

    def sample(self, times: Array) -> tuple[IndexArray, Array]:
        """Return the times at which the curve is neither at rest nor replaced, and its values."""
        return self._freed(times, *self.curve.sample(times))

    def lines(self, times: Array) -> tuple[IndexArray, Array]:
        """Return the values of `sample`, by straight lines between knots if that is much faster."""
        return self._freed(times, *self.curve.lines(times))

    def _freed(self, times: Array, index: IndexArray, values: Array) -> tuple[IndexArray, Array]:
        free = ~covers(self._spans, times[index])
        return index[free], values[free]

    def above(self, threshold: float) -> Spans:
        """Return when the curve is higher than `threshold` and not replaced, shape (n, 2)."""
        return difference(self.curve.above(threshold), self._spans)

    def origin(self, time: float) -> Origin:
        """Return the movement or segment that moves the curve at a time."""
        return self.curve.origin(time)

    def extents(self) -> Iterator[Extent]:
        """Yield the curve's extents, and the times at which it is replaced."""
        yield from self.curve.extents()
        yield from ((start, end, ("replaced",)) for start, end in self._spans.tolist())

    def breakpoints(self) -> Array:
        """Return when the curve's parts begin and end, and when it is replaced, shape (n,)."""
        return np.concatenate((self.curve.breakpoints(), self._spans.ravel()))

    def replaced_values(self, times: Array) -> Array:
        """Return the replaced values of the curve, 0 elsewhere, at sorted times, shape (n,)."""
        values = np.zeros(len(times))
        index, hidden = self.curve.sample(times)
        values[index] = hidden
        return np.where(covers(self._spans, times), values, 0.0)


def replaced_spans(curves: Iterable[ManualCurve]) -> dict[str, Spans]:
    """Return for each parameter when a drawn curve replaces the movements of all other channels."""
    by_parameter: dict[str, list[tuple[float, float]]] = {}
    for curve in curves:
        for name, keys in curve.keys.items() if curve.replaces else ():
            by_parameter.setdefault(name, []).append((keys[0][0], keys[-1][0]))
    return {name: merged(np.array(spans)) for name, spans in by_parameter.items()}


def replaced_values(curve: Curve, times: Array) -> Array:
    """Return the part of another channel's curve that a drawn curve hides, at sorted times, shape (n,)."""
    return curve.replaced_values(times) if isinstance(curve, ManualOverride) else np.zeros(len(times))
