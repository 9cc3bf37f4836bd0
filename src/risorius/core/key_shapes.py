"""Between the keys of a curve drawn by hand: straight, held, or by handles (cubic Bézier curves)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .arrays import Array
from .time import TICK

Handle = tuple[float, float]
"""The end of a handle: seconds and value, relative to its key."""
_STEP = 1.0 / 240.0  # s between the points of a curved stretch, at most
_MOST = 400  # points of one


@dataclass(frozen=True, slots=True)
class KeyShape:
    """The shape of a drawn curve at one of its keys; None is a straight line towards the neighbour.

    `before`, `after`: the handles at the key's left and right; a handle that reaches beyond the neighbour in
    time is shortened to it. `hold`: the key's value stays until the next key.
    """

    before: Handle | None = None
    after: Handle | None = None
    hold: bool = False


STRAIGHT = KeyShape()


def polyline(keys: Sequence[tuple[float, float]], shapes: Sequence[KeyShape]) -> Array:
    """Return the points (n, 2), times and values, that straight lines join to the curve; their times rise."""
    points = np.array(keys, dtype=np.float64)
    if not any(shape != STRAIGHT for shape in shapes):
        return points
    pairs = zip(points[:-1], points[1:], shapes[:-1], shapes[1:], strict=True)
    return np.concatenate((points[:1], *(_stretch(np.array([a, b]), *around) for a, b, *around in pairs)))


def _stretch(ends: Array, shape: KeyShape, following: KeyShape) -> Array:
    """Return the points after the first of two keys `ends` (2, 2), up to the second."""
    if shape.hold:
        return np.array([[ends[1, 0] - TICK, ends[0, 1]], ends[1]])
    if shape.after is None and following.before is None:
        return ends[1:]
    span = ends[1, 0] - ends[0, 0]
    straight = (ends[1] - ends[0]) / 3.0
    leaving = straight if shape.after is None else _within(shape.after, span)
    arriving = -straight if following.before is None else _within(following.before, span)
    share = np.linspace(0.0, 1.0, int(min(max(np.ceil(span / _STEP), 8), _MOST)) + 1)[1:, None]
    remaining = 1.0 - share
    bent = 3.0 * remaining**2 * share * (ends[0] + leaving) + 3.0 * remaining * share**2 * (
        ends[1] + arriving
    )
    points = remaining**3 * ends[0] + bent + share**3 * ends[1]
    points[-1] = ends[1]
    return np.asarray(points)


def _within(handle: Handle, span: float) -> Array:
    """Return a handle no longer than `span` in time: then the curve never goes back."""
    reach = abs(handle[0])
    return np.array(handle) * (span / reach if reach > span else 1.0)
