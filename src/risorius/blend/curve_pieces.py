"""The curve of one parameter in one layer: pieces that follow one another, one for each movement.

A piece has a base (onset, apex, offset) and at most one residue, which fades from the level that the piece
before it left (DESIGN, section 3). Pieces of smooth functions also take over the speed of the one before,
which dies away, so that the curve has no corner there. Pieces are compiled one by one, because each takes
over the level of the one before it (`value_at`); then all are evaluated at once (`MovementCurve`).
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterator
from dataclasses import dataclass
from operator import attrgetter
from struct import Struct
from typing import cast

import numpy as np

from ..core.arrays import Array, BoolArray, IndexArray, UInt16Array
from ..core.functions import DEFAULT_FUNCTION, ONSET_FUNCTIONS
from ..core.movement import Movement
from .intervals import Extent, Spans, merged, ranges
from .roots import find_roots


@dataclass(slots=True)
class CurvePiece:
    """The piece of a curve by which one movement moves one parameter.

    Times in seconds; `function` and `fade_function` are names.
    Onset: min(begin + rise·f, cap) during `onset`; apex: `level` until `apex_end`; offset: `level`·f
    backwards until `end`. The residue falls from `excess` with the time constant `fade`. `speed`, 1/s, is
    taken over from the piece before and dies away in `slowing`. The piece is at rest from `last` on, and it
    ends at `stop`, when the next piece takes over. `movement`: the one that targets the parameter, or the
    earlier one whose value this piece lets go.
    """

    start: float
    begin: float
    rise: float
    cap: float
    level: float
    onset: float
    apex_end: float
    offset: float
    end: float
    function: str
    movement: Movement
    excess: float = 0.0
    fade: float = 0.0
    fade_function: str = DEFAULT_FUNCTION
    speed: float = 0.0
    slowing: float = 0.0
    last: float = 0.0
    stop: float = math.inf


def _shape(name: str, x: float) -> float:
    x = min(max(x, 0.0), 1.0)
    if name == DEFAULT_FUNCTION:
        return math.exp2(x) - 1.0
    # A number is as good as an array for these formulas, and much faster.
    return float(ONSET_FUNCTIONS.get(name)(cast("Array", x)))


def value_at(s: CurvePiece, time: float) -> float:
    """Return the value of one piece at `time` >= its start."""
    x = time - s.start
    if x < s.onset:
        value = min(s.begin + s.rise * _shape(s.function, x / s.onset), s.cap) if s.rise else s.begin
    elif time <= s.apex_end:
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
    if s.speed and x < s.slowing:
        value += s.speed * x * (1.0 - x / s.slowing) ** 3
    return value


MOMENT = 1e-5
"""Seconds over which the speed of a piece is measured."""
FARTHEST = 27.0 / 256.0
"""The farthest that a decaying speed moves a curve, as a share of speed · `slowing`; reached at a quarter of
`slowing`."""


def speed_at(s: CurvePiece, time: float, value: float) -> float:
    """Return how fast a piece changes just before `time`, at which it is `value`; a second."""
    before = max(time - MOMENT, s.start)
    return (value - value_at(s, before)) / (time - before) if time > before else 0.0


def last_time(s: CurvePiece, signed: bool) -> float:
    """Return when a piece comes to rest if nothing interrupts it."""
    last = s.start
    if s.level:
        last = s.end
    elif signed and s.begin:
        last = s.start + s.onset
    if s.excess:
        exponential = s.fade_function == DEFAULT_FUNCTION
        last = max(last, s.start + s.fade * (math.log2(1.0 + s.excess) if exponential else 1.0))
    return last


_numbers = attrgetter(
    "start", "stop", "begin", "rise", "cap", "level",
    "onset", "apex_end", "offset", "end", "excess", "fade", "last", "speed", "slowing",
)  # fmt: skip
_packed = Struct("15d").pack


class CurvePieces:
    """The pieces of one parameter in one layer, in order, as numbers: objects would take more memory."""

    def __init__(self) -> None:
        self.numbers = array("d")
        self.movements: list[Movement] = []
        self.functions: dict[str, int] = {}
        self.function, self.fade_function = array("H"), array("H")

    def append(self, piece: CurvePiece) -> None:
        """Add a finished piece."""
        self.numbers.frombytes(_packed(*_numbers(piece)))
        self.movements.append(piece.movement)
        self.function.append(self.functions.setdefault(piece.function, len(self.functions)))
        self.fade_function.append(self.functions.setdefault(piece.fade_function, len(self.functions)))


def _columns(table: Array) -> list[Array]:
    """Return copies of a table's columns, each stored as one number if it is the same for all pieces."""
    count, first = len(table), table[0].copy()
    first.setflags(write=False)
    same = (table == first).all(axis=0).tolist()
    # The same arrays as from `broadcast_to`, in a tenth of its time.
    return [
        np.ndarray(count, np.float64, first, 8 * number, (0,)) if constant else table[:, number].copy()
        for number, constant in enumerate(same)
    ]


def _at(column: Array, pieces: IndexArray) -> Array:
    """Return a column's numbers of some pieces (n,), shape (n,), or (1,) if all pieces have the same."""
    return column[:1] if column.strides == (0,) else column.take(pieces)


class MovementCurve:
    """All pieces of one parameter in one layer, evaluated at any times."""

    def __init__(self, pieces: CurvePieces) -> None:
        table = np.array(pieces.numbers).reshape(len(pieces.movements), -1)
        columns = _columns(table)
        self.start, self.stop, self.begin, self.rise, self.cap, self.level = columns[:6]
        self.onset, self.apex_end, self.offset, self.end, self.excess, self.fade, self.last = columns[6:13]
        self.speed, self.slowing = columns[13:]
        # Most curves let nothing go, and keep no speed.
        self._lets_go, self._keeps_speed = bool(self.excess.any()), bool(self.speed.any())
        self._movements = tuple(pieces.movements)
        self.functions = tuple(pieces.functions)
        self.function, self.fade_function = np.array(pieces.function), np.array(pieces.fade_function)

    def sample(self, times: Array) -> tuple[IndexArray, Array]:
        """Return the times at which the curve is not at rest, and its values at them.

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
        return index, self.evaluate(chosen.take(owner), times.take(index))

    lines = sample

    def evaluate(self, pieces: IndexArray, times: Array) -> Array:
        """Return the values of pieces (n,), each at its own time (not before its start), shape (n,)."""
        x = times - self.start.take(pieces)
        values: Array = self.level.take(pieces)
        rising = x < _at(self.onset, pieces)
        (i,) = (rising & (_at(self.rise, pieces) != 0.0)).nonzero()
        if len(i):
            k = pieces.take(i)
            begin, rise, onset = (_at(column, k) for column in (self.begin, self.rise, self.onset))
            risen = begin + rise * self._shapes(self.function.take(k), x.take(i) / onset)
            values[i] = np.minimum(risen, _at(self.cap, k))
        (i,) = (~rising & (times > _at(self.apex_end, pieces))).nonzero()
        if len(i):
            k = pieces.take(i)
            left, offset = np.maximum(self.end.take(k) - times.take(i), 0.0), self.offset.take(k)
            part = np.divide(left, offset, out=np.zeros(len(i)), where=offset > 0.0)
            values[i] *= self._shapes(self.function.take(k), part)
        if self._lets_go:
            self._add_residue(values, pieces, x)
        if self._keeps_speed:
            i = np.flatnonzero((self.speed[pieces] != 0.0) & (x < self.slowing[pieces]))
            k = pieces[i]
            values[i] += self.speed[k] * x[i] * (1.0 - x[i] / self.slowing[k]) ** 3
        return values

    def _add_residue(self, values: Array, pieces: IndexArray, x: Array) -> None:
        i = np.flatnonzero((self.excess[pieces] != 0.0) & (x < self.fade[pieces]))
        k = pieces[i]
        part, excess = x[i] / self.fade[k], self.excess[k]
        plain = np.array([name == DEFAULT_FUNCTION for name in self.functions])[self.fade_function[k]]
        residue = np.maximum(0.0, (1.0 + excess) * np.exp2(-part) - 1.0)
        if not plain.all():
            other = excess * (1.0 - self._shapes(self.fade_function[k], part))
            residue = np.where(plain, residue, other)
        values[i] += residue

    def _shapes(self, numbers: UInt16Array, x: Array) -> Array:
        """Return f(x), each element by its own function, with x clipped to [0, 1]; shape (n,)."""
        x = np.minimum(x, 1.0)
        if not len(x):
            return x
        if (numbers == numbers[0]).all():
            return np.asarray(ONSET_FUNCTIONS.get(self.functions[numbers[0]])(x))
        values = np.empty(len(x))
        for number, name in enumerate(self.functions):
            mine = numbers == number
            values[mine] = ONSET_FUNCTIONS.get(name)(x[mine])
        return values

    def origin(self, time: float) -> Movement:
        """Return the movement that moves the curve at a time."""
        return self._movements[max(int(np.searchsorted(self.start, time, side="right")) - 1, 0)]

    def extents(self) -> Iterator[Extent]:
        """Yield the extent of each piece, with all its numbers."""
        numbers = (
            self.begin,
            self.rise,
            self.cap,
            self.level,
            self.onset,
            self.apex_end,
            self.offset,
            self.end,
        )
        until = np.minimum(self.last, self.stop)
        residue = (self.excess, self.fade, self.speed, self.slowing)
        rows = np.column_stack((self.start, until, *numbers, *residue)).tolist()
        for row, shape, fade in zip(rows, self.function, self.fade_function, strict=True):
            yield row[0], row[1], (*row[2:], self.functions[shape], self.functions[fade])

    def breakpoints(self) -> Array:
        """Return when pieces begin and end, unsorted, shape (m,)."""
        return np.concatenate((self.start, np.minimum(self.last, self.stop)))

    def above(self, threshold: float) -> Spans:
        """Return when the curve is higher than `threshold` >= 0, shape (n, 2).

        A piece rises at most once, so it is higher in a single interval; the ends of that interval are roots
        of the curve.
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
        self, pieces: IndexArray, threshold: float, low: Array, high: Array, chosen: BoolArray
    ) -> Array:
        """Return when in [low, high] the chosen pieces cross the threshold, 0 for others, shape (n,)."""
        crossings = np.zeros(len(pieces))
        k = pieces[chosen]
        if len(k):
            crossings[chosen] = find_roots(
                lambda t: self.evaluate(k, t) - threshold, low[chosen], high[chosen]
            )
        return crossings
