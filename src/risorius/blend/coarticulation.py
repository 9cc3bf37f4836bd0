"""How neighbouring lip segments blend: the interface of all models, and what they share.

A model says how much each segment weighs at a time, per parameter. Everything else (targets, limits on
other channels, whether the mouth speaks) is an average by these weights. A new model is a file that
registers itself here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, TypeVar

import numpy as np

from ..core.movement import LipSegment
from ..core.utterance import SILENCE
from ..registry import Registry
from .intervals import Array, Indices

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Weights:
    """Weights of segments at some times, as triples: segment, index of the time, weight; each shape (m,).

    They sum to 1 at each of the `count` times, or to 0 far from all segments.
    """

    segment: Indices
    time: Indices
    weight: Array
    count: int

    def average(self, values: Array) -> Array:
        """Return the weighted average of one value per segment, shape (segments,), at the times: (count,)."""
        spread = np.bincount(self.time, self.weight * values[self.segment], self.count)
        return np.asarray(spread, dtype=np.float64)


class Shared:
    """Mappings of segments, many of which are the same object.

    `mappings`: each once; `number`: which of them each segment has, shape (segments,).
    """

    def __init__(self, mappings: Sequence[Mapping[str, Any]]) -> None:
        known: dict[int, int] = {}
        self.number = np.array([known.setdefault(id(m), len(known)) for m in mappings], dtype=np.intp)
        _, self._first = np.unique(self.number, return_index=True)
        self.mappings = self.first(mappings)

    def first(self, items: Sequence[T]) -> tuple[T, ...]:
        """Return one item per segment for the first segment that has each mapping."""
        return tuple(items[i] for i in self._first.tolist())

    def column(self, name: str, missing: float) -> Array:
        """Return the value of a name for every segment, shape (segments,)."""
        values = np.array([m.get(name, missing) for m in self.mappings], dtype=np.float64)
        return np.asarray(values[self.number])


class Coarticulation(Protocol):
    """A model made for some segments: sorted, without gaps; `reach`: how far a segment is felt, seconds."""

    reach: float

    def group(self, parameter: str) -> int:
        """Return a number; parameters with the same number have the same weights at all times."""

    def targets(self, parameter: str) -> Array:
        """Return each segment's target for the parameter, 0 where it has none, shape (segments,)."""

    def weights(self, group: int, times: Array) -> Weights:
        """Return the weights of one group's parameters at sorted times, shape (n,)."""


class Averages:
    """The averages of a model's targets at sorted times, shape (n,); weights are made once for each group."""

    def __init__(self, model: Coarticulation, times: Array) -> None:
        self._model, self._times = model, times
        self._weights: dict[int, Weights] = {}
        self._values: dict[str, Array] = {}

    def __call__(self, name: str) -> Array:
        """Return the average of one target, shape (n,)."""
        if name not in self._values:
            self._values[name] = self.weights(name).average(self._model.targets(name))
        return self._values[name]

    def weights(self, name: str) -> Weights:
        """Return the weights for one target or parameter."""
        group = self._model.group(name)
        if group not in self._weights:
            self._weights[group] = self._model.weights(group, self._times)
        return self._weights[group]


LIP_MODELS: Registry[Callable[[Sequence[LipSegment]], Coarticulation]] = Registry("lip model")

SHORTEST_SILENCE = 0.15
"""Seconds: a shorter gap between segments (the release of a stop, a breath) belongs to its neighbours."""
_LEAD = 2.0
"""Seconds of rest put before the first and after the last segment."""


def without_gaps(segments: Sequence[LipSegment]) -> tuple[LipSegment, ...]:
    """Return the segments by time, with silence in every long gap between them and at both ends."""
    ordered = sorted(segments, key=lambda s: (s.start, s.end, s.phone))
    if not ordered:
        return ()
    filled: list[LipSegment] = []
    covered = ordered[0].start - _LEAD
    for segment in ordered:
        if segment.start >= covered + SHORTEST_SILENCE:
            filled.append(LipSegment(SILENCE, covered, segment.start, {}))
        filled.append(segment)
        covered = max(covered, segment.end)
    filled.append(LipSegment(SILENCE, covered, covered + _LEAD, {}))
    return tuple(filled)
