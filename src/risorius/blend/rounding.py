"""Rounding: curves have no corners where a maximum, an inhibition or a limit switches.

Each curve is averaged over a short time around every moment, before the contact goals, with weights that
fall off to both sides. The average is taken at a few times around the moment itself, so that it does not
depend on the frame rate, and at many where these few show a corner: few keep some small corners of a large one.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

import numpy as np

from ..core.arrays import Array
from ..core.functions import CORNERED
from ..core.parameters import INDEX, PARAMETERS, Kind
from ..core.score import Score
from .intervals import Spans, merged

SAMPLES, MANY = 6, 12
"""Times around a moment at which a curve is read, and where it has a corner."""
REACH = 0.75
"""How far from a moment a curve is read, as a share of the time over which it is averaged: weights that fall
off evenly over one and a half times that time are worth as much as equal weights over all of it."""
SHARP = 0.001
"""From which fourth difference of a curve that is read at a few times on it may have a corner, as a share of
the parameter's range: more than most smooth movements have."""
QUICK = 0.25
"""The share of the time over which lids and eyes are rounded: their fastest movements take some 30 ms."""


class Rounding:
    """Over which time each parameter of a score is averaged, and where it is left as it is."""

    def __init__(self, score: Score) -> None:
        self._width = score.settings.rounding
        self._exact = _spans_of(score, self._width) if self._width else {}

    def width(self, name: str) -> float:
        """Return the seconds over which a parameter is averaged; 0: it is not."""
        parameter = PARAMETERS[INDEX[name]]
        if parameter.kind is Kind.TONGUE:
            return 0.0  # speech alone moves it: nothing switches
        quick = parameter.group == "lids" or parameter.kind in (Kind.GAZE, Kind.DISTANCE)
        return self._width * QUICK if quick else self._width

    def exact(self, name: str, times: Array) -> Array:
        """Return at which times, shape (n,), a parameter keeps its corners: bool (n,)."""
        spans = self._exact.get(name)
        if spans is None:
            return np.zeros(len(times), dtype=bool)
        number = np.searchsorted(spans[:, 0], times, side="right") - 1
        return np.asarray((number >= 0) & (times <= spans[number, 1]))


class Surroundings:
    """The times around some sorted times (n,) at which curves are read for averages over `width` seconds.

    `samples`: how many for each. Nothing is read before 0 or after `end`.
    """

    def __init__(self, times: Array, width: float, end: float, samples: int = SAMPLES) -> None:
        aside = ((np.arange(samples) + 0.5) * 2.0 - samples) / samples
        weights = 1.0 - np.abs(aside)
        self._weights = (weights / weights.sum())[1:, np.newaxis]
        spread = np.clip(times + REACH * width * aside[:, np.newaxis], 0.0, end).ravel()
        order = np.argsort(spread, kind="stable")
        self.times, self._place = spread[order], np.empty(len(order), np.intp)
        self._place[order] = np.arange(len(order))

    def average(self, values: Array) -> Array:
        """Return the averages (n,) of values at `times`; of equal values exactly their value."""
        around = self._around(values)
        # Of differences, so that those of equal values are exactly 0.
        return np.asarray(around[0] + ((around[1:] - around[0]) * self._weights).sum(axis=0))

    def sharpness(self, values: Array) -> Array:
        """Return the largest fourth difference around each time, shape (n,), of values at `times`."""
        return np.asarray(np.abs(np.diff(self._around(values), 4, axis=0)).max(axis=0))

    def _around(self, values: Array) -> Array:
        return values.take(self._place).reshape(len(self._weights) + 1, -1)


def _spans_of(score: Score, width: float) -> dict[str, Spans]:
    """Return where each parameter has corners that are meant: drawn by hand, or of a sharp movement."""
    found: dict[str, list[tuple[float, float]]] = defaultdict(list)
    for m in score.movements:
        if (score.settings.onset_function or m.function) in CORNERED or 0.0 in (m.onset, m.offset):
            _add(found, m.parameters, m.start - width, m.end + width)
    for curve in score.manual:
        for name, keys in curve.keys.items():
            _add(found, (name,), keys[0][0] - width, keys[-1][0] + width)
    return {name: merged(np.array(sorted(spans))) for name, spans in found.items()}


def _add(found: dict[str, list[tuple[float, float]]], names: Iterable[str], start: float, end: float) -> None:
    for name in names:
        found[name].append((start, end))
