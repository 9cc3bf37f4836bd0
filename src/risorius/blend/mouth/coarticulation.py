"""Coarticulation, blending of neighbouring lip segments: the interface of all lip models, and shared parts.

A model blends any value of the segments, per parameter: targets, limits on other channels, whether the mouth
speaks. Each blend is an average by the weights of the segments, which it names on demand. A new model is a
file that registers itself here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from ...core.arrays import AnyArray, Array, IndexArray
from ...core.movement import DEFAULT_DOMINANCE, LipSegment, silent_dominance
from ...core.registry import Registry
from ...core.speech.utterance import SILENCE

T = TypeVar("T")
SegmentRow = TypeVar("SegmentRow", bound=AnyArray)


@dataclass(frozen=True, slots=True)
class SegmentWeights:
    """Weights of segments at some times, as triples: segment, index of the time, weight; each shape (m,).

    The weights sum to 1 at each of the `count` times, or to 0 far from all segments. Those of `effort` may be
    slightly below 0.
    """

    segment: IndexArray
    time: IndexArray
    weight: Array
    count: int

    def average(self, values: Array | SegmentValues) -> Array:
        """Return the weighted average of `values` (segments,) at each time, shape (count,)."""
        spread = np.bincount(self.time, self.weight * values[self.segment], self.count)
        return np.asarray(spread, dtype=np.float64)


class SegmentValues:
    """One value per segment, shape (segments,), in little memory: there are few different values."""

    def __init__(self, values: Array) -> None:
        self._distinct, number = np.unique(values, return_inverse=True)
        self._number = number.astype(np.uint16 if len(self._distinct) <= 2**16 else np.uint32)

    def __getitem__(self, segments: IndexArray) -> Array:
        """Return the values of some segments, shape (n,) -> (n,)."""
        return np.asarray(self._distinct[self._number[segments]])

    def within(self, average: Array) -> Array:
        """Return an average (n,), clipped to the range of the values."""
        return np.clip(average, self._distinct[0], self._distinct[-1])


class SharedMappings:
    """One mapping per segment; many segments share the same object.

    `mappings`: each object once; `number`: the number of each segment's mapping, shape (segments,).
    """

    def __init__(self, mappings: Sequence[Mapping[str, Any]]) -> None:
        known: dict[int, int] = {}
        self.number = np.array([known.setdefault(id(m), len(known)) for m in mappings], dtype=np.uint32)
        _, self._first = np.unique(self.number, return_index=True)
        self.mappings = self.first(mappings)

    def first(self, items: Sequence[T]) -> tuple[T, ...]:
        """Return, for each mapping, the item of the first segment that has it."""
        return tuple(items[i] for i in self._first.tolist())

    def column(self, name: str, missing: float) -> Array:
        """Return the value of a name for every segment, shape (segments,)."""
        values = np.array([m.get(name, missing) for m in self.mappings], dtype=np.float64)
        return np.asarray(values[self.number])


class ParameterGroups(Generic[SegmentRow]):
    """Parameters for which the segments have the same values: a row of them (segments,) for each group.

    `row_of` returns a parameter's row.
    """

    def __init__(self, row_of: Callable[[str], SegmentRow]) -> None:
        self._row_of = row_of
        self._known: dict[bytes, int] = {}
        self._numbers: dict[str, int] = {}
        self.rows: list[SegmentRow] = []

    def number(self, parameter: str) -> int:
        """Return the number of a parameter's group."""
        if parameter not in self._numbers:
            row = self._row_of(parameter)
            known = self._known.setdefault(row.tobytes(), len(self.rows))
            if known == len(self.rows):
                self.rows.append(row)
            self._numbers[parameter] = known
        return self._numbers[parameter]


class Coarticulation(Protocol):
    """A lip model for segments that are sorted and without gaps.

    `reach`: how far a segment has weight beyond its ends, seconds.
    """

    reach: float

    def group(self, parameter: str) -> int:
        """Return the number of a parameter's group: parameters of one group have the same weights."""

    def targets(self, parameter: str) -> Array:
        """Return each segment's target for the parameter, 0 if it has none, shape (segments,)."""

    def weights(self, group: int, times: Array) -> SegmentWeights:
        """Return the weights of one group's parameters at sorted times, shape (n,)."""

    def averages(self, group: int, values: Sequence[SegmentValues], times: Array) -> list[Array]:
        """Return the averages of some values by the weights of a group at sorted times, shape (n,) each."""


AT_ONCE = 2048
"""Times per block of weights, which need far more memory than the averages."""


def weighted_averages(
    model: Coarticulation, group: int, values: Sequence[SegmentValues], times: Array
) -> list[Array]:
    """Return the averages for `Coarticulation.averages`, by a model's weights."""
    averages = [np.empty(len(times)) for _ in values]
    for first in range(0, len(times), AT_ONCE):
        part = slice(first, first + AT_ONCE)
        weights = model.weights(group, times[part])
        for value, average in zip(values, averages, strict=True):
            average[part] = weights.average(value)
    return averages


AverageKey = tuple[str, str]
"""A kind of value that is averaged, and the parameter that it is of."""
TARGET = "target"


class SegmentTable:
    """The values that are averaged by the weights of `model`: one per segment, by key."""

    def __init__(self, model: Coarticulation, values: Mapping[AverageKey, SegmentValues]) -> None:
        self.model = model
        self.values = values
        self._sharing: dict[int, list[AverageKey]] = {}
        for key in values:
            self._sharing.setdefault(model.group(key[1]), []).append(key)

    def sharing(self, group: int) -> Sequence[AverageKey]:
        """Return the keys of all values that are averaged by the weights of a group."""
        return self._sharing[group]


class SegmentAverages:
    """The averages of a table at sorted times, shape (n,).

    All averages of a group are computed together, and each is returned once.
    """

    def __init__(self, columns: SegmentTable, times: Array) -> None:
        self._columns, self._times = columns, times
        self._computed: dict[AverageKey, Array] = {}

    def __call__(self, name: str) -> Array:
        """Return the average of a target, shape (n,)."""
        return self.of(TARGET, name)

    def of(self, kind: str, name: str) -> Array:
        """Return the average of a kind of value, shape (n,), 0 if the table has none, and forget it."""
        key = (kind, name)
        if key not in self._columns.values:
            return np.zeros(len(self._times))
        # If another thread needs it at the same time, both compute it.
        average_values = self._computed.pop(key, None)
        if average_values is None:
            averages = self._group_averages(self._columns.model.group(name))
            average_values = averages.pop(key)
            self._computed.update(averages)
        return average_values

    def _group_averages(self, group: int) -> dict[AverageKey, Array]:
        keys = self._columns.sharing(group)
        values = [self._columns.values[key] for key in keys]
        averages = self._columns.model.averages(group, values, self._times)
        # A weight may be below 0: an average still lies among the values of segments that hold one.
        return {
            key: average if key[0] == TARGET else value.within(average)
            for key, value, average in zip(keys, values, averages, strict=True)
        }


LIP_MODELS: Registry[Callable[[Sequence[LipSegment]], Coarticulation]] = Registry("lip model")

SHORTEST_SILENCE = 0.15
"""Seconds: a shorter gap between segments (the release of a stop, a breath) belongs to its neighbours."""
_LEAD = 2.0
"""Seconds of rest before the first and after the last segment."""


def silence(start: float, end: float) -> LipSegment:
    """Return a segment at rest from `start` to `end`, seconds."""
    return LipSegment(
        SILENCE, start, end, {}, dominance={"*": silent_dominance(DEFAULT_DOMINANCE, end - start)}
    )


def without_gaps(segments: Sequence[LipSegment]) -> tuple[LipSegment, ...]:
    """Return the segments by time, with silence in every long gap between them and at both ends."""
    ordered = sorted(segments, key=lambda s: (s.start, s.end, s.phone))
    if not ordered:
        return ()
    filled: list[LipSegment] = []
    covered = ordered[0].start - _LEAD
    for segment in ordered:
        if segment.start >= covered + SHORTEST_SILENCE:
            filled.append(silence(covered, segment.start))
        filled.append(segment)
        covered = max(covered, segment.end)
    filled.append(silence(covered, covered + _LEAD))
    return tuple(filled)
