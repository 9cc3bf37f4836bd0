"""Rounding: curves have no corners where a maximum, an inhibition or a limit switches.

Each curve is averaged over a short time around every moment, before the contact goals. The average is taken
at a few times around the moment itself, so that it does not depend on the frame rate; of the brows at more if
these few show a corner.
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

SAMPLES, MORE = 6, 12
"""Times around a moment at which a curve is read: few leave some small corners of a large one."""
SHARP = 0.001
"""Fourth difference of the values at a few times from which there may be a corner: smooth movements of
the brows have less."""
FALLING = 1.5
"""Triangular weights smooth as much as equal weights over a time shorter by this factor."""
QUICK = 0.25
"""The share of the time over which lids and eyes are rounded: their fastest movements take some 30 ms."""


def is_quick(name: str) -> bool:
    """Return whether a parameter is one of the lids or eyes."""
    parameter = PARAMETERS[INDEX[name]]
    return parameter.group == "lids" or parameter.kind in (Kind.GAZE, Kind.DISTANCE)


class Rounding:
    """Over which time each parameter of a score is averaged, and where it is left as it is."""

    def __init__(self, score: Score) -> None:
        self._width = score.settings.rounding
        self._exact = _spans_of(score, self._width) if self._width else {}

    def width(self, name: str) -> float:
        """Return the seconds over which a parameter is averaged; 0: it is not."""
        if PARAMETERS[INDEX[name]].kind is Kind.TONGUE:
            return 0.0  # speech alone moves it: nothing switches
        return self._width * QUICK if is_quick(name) else self._width

    def even(self, name: str) -> bool:
        """Return whether all that is read around a moment counts alike (`SmoothingWindow`).

        Of the brows what is farther away counts less: a signal takes over from a display in full speed, and
        may stand out for a shorter time than `width`, so that equal weights would leave two corners.
        """
        return PARAMETERS[INDEX[name]].group != "brows"

    def exact(self, name: str, times: Array) -> Array:
        """Return at which times, shape (n,), a parameter keeps its corners: bool (n,)."""
        spans = self._exact.get(name)
        if spans is None:
            return np.zeros(len(times), dtype=bool)
        number = np.searchsorted(spans[:, 0], times, side="right") - 1
        return np.asarray((number >= 0) & (times <= spans[number, 1]))


class SmoothingWindow:
    """The times around some sorted times (n,) at which curves are read for averages over `width` seconds.

    `even`: all count alike; else those that are farther away count less. `samples`: how many for each time.
    Nothing is read before 0 or after `end`.
    """

    def __init__(
        self, times: Array, width: float, end: float, *, even: bool = True, samples: int = SAMPLES
    ) -> None:
        aside = ((np.arange(samples) + 0.5) * 2.0 - samples) / samples
        weights = np.ones(samples) if even else 1.0 - np.abs(aside)
        self._weights = (weights / weights.sum())[1:, np.newaxis]
        reach = 0.5 * (width if even else FALLING * width)
        spread = np.clip(times + reach * aside[:, np.newaxis], 0.0, end).ravel()
        order = np.argsort(spread, kind="stable")
        self.times, self._place = spread[order], np.empty(len(order), np.intp)
        self._place[order] = np.arange(len(order))

    def average(self, values: Array) -> Array:
        """Return the averages (n,) of values at `times`; of equal values exactly their value."""
        around = self._around(values)
        # Differences are averaged, so that equal values give exactly their value.
        return np.asarray(around[0] + ((around[1:] - around[0]) * self._weights).sum(axis=0))

    def sharpness(self, values: Array) -> Array:
        """Return the largest fourth difference around each time, shape (n,), of values at `times`."""
        return np.asarray(np.abs(np.diff(self._around(values), 4, axis=0)).max(axis=0))

    def _around(self, values: Array) -> Array:
        return values.take(self._place).reshape(len(self._weights) + 1, -1)


def _spans_of(score: Score, width: float) -> dict[str, Spans]:
    """Return where each parameter has corners that are meant: drawn by hand, or of a sharp movement."""
    spans_by_name: dict[str, list[tuple[float, float]]] = defaultdict(list)
    for m in score.movements:
        if (score.settings.onset_function or m.function) in CORNERED or 0.0 in (m.onset, m.offset):
            _add(spans_by_name, m.parameters, m.start - width, m.end + width)
    for curve in score.manual:
        for name, keys in curve.keys.items():
            _add(spans_by_name, (name,), keys[0][0] - width, keys[-1][0] + width)
    return {name: merged(np.array(sorted(spans))) for name, spans in spans_by_name.items()}


def _add(spans: dict[str, list[tuple[float, float]]], names: Iterable[str], start: float, end: float) -> None:
    for name in names:
        spans[name].append((start, end))
