"""The curve of one parameter in one layer: strokes, one for each movement, that follow one another.

A stroke is a base (onset, apex, offset) and at most one residue of what the movement before it left
(DESIGN, section 3). Strokes are compiled one by one (`value_at` gives the level a stroke takes over) and
then evaluated all at once (`StrokeCurve`).
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterator
from dataclasses import dataclass
from operator import attrgetter

import numpy as np

from ..core.arrays import Array, BoolArray, IndexArray, UInt16Array
from ..core.functions import DEFAULT_FUNCTION, ONSET_FUNCTIONS
from ..core.movement import Movement
from .intervals import Piece, Spans, merged, ranges
from .roots import find_roots


@dataclass(slots=True)
class Stroke:
    """What one movement makes of one parameter. Seconds; `function` and `fade_function` are names.

    `movement`: the one that asks for it, or had asked for what is here let go.
    Onset: min(begin + rise·f, cap) during `onset`; apex: `level` until `hold`; offset: `level`·f backwards
    to `end`. The residue falls from `excess` with the time constant `fade`. Nothing from `last` on, nor
    from `stop`, where the next stroke takes over.
    """

    start: float
    begin: float
    rise: float
    cap: float
    level: float
    onset: float
    hold: float
    offset: float
    end: float
    function: str
    movement: Movement
    excess: float = 0.0
    fade: float = 0.0
    fade_function: str = DEFAULT_FUNCTION
    last: float = 0.0
    stop: float = math.inf


def _shape(name: str, x: float) -> float:
    x = min(max(x, 0.0), 1.0)
    if name == DEFAULT_FUNCTION:
        return math.exp2(x) - 1.0
    return float(ONSET_FUNCTIONS.get(name)(np.asarray(x, dtype=np.float64)))


def value_at(s: Stroke, time: float) -> float:
    """Return the value of one stroke at `time` >= its start."""
    x = time - s.start
    if x < s.onset:
        value = min(s.begin + s.rise * _shape(s.function, x / s.onset), s.cap) if s.rise else s.begin
    elif time <= s.hold:
        value = s.level
    elif time < s.end:
        value = s.level * _shape(s.function, (s.end - time) / s.offset)
    else:
        value = 0.0
    if s.excess and x < s.fade:
        if s.fade_function == DEFAULT_FUNCTION:
            value += max(0.0, (1.0 + s.excess) * math.exp2(-x / s.fade) - 1.0)
        else:
            value += s.excess * (1.0 - _shape(s.fade_function, x / s.fade))
    return value


def last_time(s: Stroke, signed: bool) -> float:
    """Return when a stroke has come to rest, were it never interrupted."""
    rest = s.start
    if s.level:
        rest = s.end
    elif signed and s.begin:
        rest = s.start + s.onset
    if s.excess:
        exponential = s.fade_function == DEFAULT_FUNCTION
        rest = max(rest, s.start + s.fade * (math.log2(1.0 + s.excess) if exponential else 1.0))
    return rest


_numbers = attrgetter(
    "start", "stop", "begin", "rise", "cap", "level",
    "onset", "hold", "offset", "end", "excess", "fade", "last",
)  # fmt: skip


class Strokes:
    """Strokes of one parameter in one layer, in order, by their numbers alone, which stay small."""

    def __init__(self) -> None:
        self.numbers = array("d")
        self.movements: list[Movement] = []
        self.functions: dict[str, int] = {}
        self.function, self.fade_function = array("H"), array("H")

    def append(self, stroke: Stroke) -> None:
        """Take in a stroke that nothing changes any more."""
        self.numbers.extend(_numbers(stroke))
        self.movements.append(stroke.movement)
        self.function.append(self.functions.setdefault(stroke.function, len(self.functions)))
        self.fade_function.append(self.functions.setdefault(stroke.fade_function, len(self.functions)))

    def key(self) -> object:
        """Return what is the same for the same strokes."""
        numbers = (self.numbers, self.function, self.fade_function)
        return (*(n.tobytes() for n in numbers), *self.functions, *map(id, self.movements))


def _compact(column: Array) -> Array:
    """Return a column by itself, and as one number where it is the same for all strokes."""
    same = bool((column == column[0]).all())
    return np.broadcast_to(column[0], len(column)) if same else column.copy()


class StrokeCurve:
    """All strokes of one parameter in one layer, evaluated at any times."""

    def __init__(self, strokes: Strokes) -> None:
        table = np.array(strokes.numbers).reshape(len(strokes.movements), -1)
        columns = [_compact(column) for column in table.T]
        self.start, self.stop, self.begin, self.rise, self.cap, self.level = columns[:6]
        self.onset, self.hold, self.offset, self.end, self.excess, self.fade, self.last = columns[6:]
        self._movements = tuple(strokes.movements)
        self.functions = tuple(strokes.functions)
        self.function, self.fade_function = np.array(strokes.function), np.array(strokes.fade_function)

    def sample(self, times: Array) -> tuple[IndexArray, Array]:
        """Return where the curve is not at rest and its values there.

        `times`: sorted, shape (n,). Returns indices into it, strictly increasing, and values, both (m,).
        """
        first = int(np.searchsorted(self.start, times[0], side="right")) - 1
        ending = int(np.searchsorted(self.start, times[-1], side="right"))
        chosen = np.arange(max(first, 0), ending)
        low = np.searchsorted(times, self.start[chosen], side="left")
        high = np.minimum(
            np.searchsorted(times, self.last[chosen], side="right"),
            np.searchsorted(times, self.stop[chosen], side="left"),
        )
        owner, index = ranges(low, high)
        return index, self.evaluate(chosen[owner], times[index])

    lines = sample

    def evaluate(self, strokes: IndexArray, times: Array) -> Array:
        """Return the values of the given strokes, each at its own time (not before its start), shape (n,)."""
        x = times - self.start[strokes]
        values: Array = self.level[strokes]
        rising = x < self.onset[strokes]
        i = np.flatnonzero(rising & (self.rise[strokes] != 0.0))
        k = strokes[i]
        risen = self.begin[k] + self.rise[k] * self._shapes(self.function[k], x[i] / self.onset[k])
        values[i] = np.minimum(risen, self.cap[k])
        i = np.flatnonzero(~rising & (times > self.hold[strokes]))
        k = strokes[i]
        left = np.maximum(self.end[k] - times[i], 0.0)
        part = np.divide(left, self.offset[k], out=np.zeros(len(i)), where=self.offset[k] > 0.0)
        values[i] *= self._shapes(self.function[k], part)
        self._add_residue(values, strokes, x)
        return values

    def _add_residue(self, values: Array, strokes: IndexArray, x: Array) -> None:
        i = np.flatnonzero((self.excess[strokes] != 0.0) & (x < self.fade[strokes]))
        k = strokes[i]
        part, excess = x[i] / self.fade[k], self.excess[k]
        plain = np.array([name == DEFAULT_FUNCTION for name in self.functions])[self.fade_function[k]]
        residue = np.maximum(0.0, (1.0 + excess) * np.exp2(-part) - 1.0)
        if not plain.all():
            other = excess * (1.0 - self._shapes(self.fade_function[k], part))
            residue = np.where(plain, residue, other)
        values[i] += residue

    def _shapes(self, numbers: UInt16Array, x: Array) -> Array:
        """f(x) of each element's own function, x cut to [0, 1]; shape (n,)."""
        x = np.minimum(x, 1.0)
        if len(self.functions) == 1:
            return np.asarray(ONSET_FUNCTIONS.get(self.functions[0])(x))
        values = np.empty(len(x))
        for number, name in enumerate(self.functions):
            mine = numbers == number
            values[mine] = ONSET_FUNCTIONS.get(name)(x[mine])
        return values

    def origin(self, time: float) -> Movement:
        """Return the movement behind the curve at a time."""
        return self._movements[max(int(np.searchsorted(self.start, time, side="right")) - 1, 0)]

    def pieces(self) -> Iterator[Piece]:
        """Yield each stroke: from when to when it is in force, and all that it is made of."""
        numbers = (self.begin, self.rise, self.cap, self.level, self.onset, self.hold, self.offset, self.end)
        until = np.minimum(self.last, self.stop)
        rows = np.column_stack((self.start, until, *numbers, self.excess, self.fade)).tolist()
        for row, shape, fade in zip(rows, self.function, self.fade_function, strict=True):
            yield row[0], row[1], (*row[2:], self.functions[shape], self.functions[fade])

    def breakpoints(self) -> Array:
        """Return when strokes begin and end, unsorted, shape (m,)."""
        return np.concatenate((self.start, np.minimum(self.last, self.stop)))

    def above(self, threshold: float) -> Spans:
        """Return when the curve is higher than `threshold` >= 0, shape (n, 2).

        A stroke rises (at most once) and then never rises again, so it is higher in one interval, whose
        ends are found on the curve itself.
        """
        until = np.minimum(self.last, self.stop)
        everyone = np.arange(len(self.start))
        first = self.evaluate(everyone, self.start)
        top = np.where(self.rise > 0.0, np.minimum(self.start + self.onset, until), self.start)
        peak = self.evaluate(everyone, top)
        k = np.flatnonzero((np.maximum(first, peak) > threshold) & (until > self.start))
        on = self._crossing(k, threshold, self.start[k], top[k], first[k] <= threshold)
        final = self.evaluate(k, until[k])
        off = self._crossing(k, threshold, top[k], until[k], final <= threshold)
        on = np.where(first[k] > threshold, self.start[k], on)
        off = np.where(final > threshold, until[k], off)
        return merged(np.column_stack((on, off))[on < off])

    def _crossing(
        self, strokes: IndexArray, threshold: float, low: Array, high: Array, wanted: BoolArray
    ) -> Array:
        """The times in [low, high] at which the wanted strokes cross the threshold, shape (n,)."""
        found = np.zeros(len(strokes))
        k = strokes[wanted]
        if len(k):
            found[wanted] = find_roots(lambda t: self.evaluate(k, t) - threshold, low[wanted], high[wanted])
        return found
