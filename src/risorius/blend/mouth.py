"""While lips speak they own the mouth's opening: their limits on other channels, and their share of the jaw.

All is worked on knots: times that divide every segment evenly, at most `STEP` apart, so that results do not
depend on the frame rate and move with the segments. Between knots lie straight lines. Knots are made in
blocks of time, so that memory does not grow with the score.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, lru_cache

import numpy as np

from ..core.arrays import Array
from ..core.movement import LipSegment
from ..core.parameters import RIVALS
from ..core.utterance import SILENCE
from .approach import Approach
from .coarticulation import (
    TARGET,
    Coarticulation,
    SegmentAverages,
    SegmentTable,
    SegmentValues,
    SharedMappings,
)
from .contact import CONTACTS, SEAL, Goal
from .intervals import EMPTY, Spans, above_line, spans_between, union
from .knots import BLOCK, STEEPEST, Knots, block_knots, block_number, envelope
from .roots import find_roots
from .shapes import Shapes
from .tuning import Tuning

STEP = 0.005
"""Seconds between knots at most."""
HAIR = 1e-9
"""A limit or average that equals a threshold, but for rounding, is not above it."""
SegmentLimits = Mapping[str, tuple[float, float]]
"""The lower and upper limit of each parameter that a segment limits."""
JAW = "masseter"
JAW_AT_SEAL = 0.2
"""The most that the jaw may be open while the lips are sealed."""
SPEAKS, LOW, MISSING = "speaks", "low", "missing"
"""Averaged besides targets: 1 for all but silence; a lower limit; what an upper limit leaves to 1."""


class SpeechMouth:
    """What the lip segments ask of the rest of the face.

    `segments`: sorted, without gaps, at least one; `limits`: those of each in force; `model`, `shapes` and
    `goals` (the contact goals in force): what is made of the segments as a head performs them.
    """

    def __init__(
        self,
        segments: Sequence[LipSegment],
        limits: Sequence[SegmentLimits],
        model: Coarticulation,
        shapes: Shapes,
        goals: Sequence[Goal],
        tuning: Tuning,
    ) -> None:
        self.segments = tuple(segments)
        self.model = model
        self.shapes = shapes
        self.goals = tuple(goals)
        self.approach = Approach(goals)
        self.tuning = tuning
        self.limits = tuple(limits)
        self._shared = SharedMappings(self.limits)
        self.limited = frozenset(name for held in self._shared.mappings for name in held)
        self.raised = frozenset(n for m in self._shared.mappings for n, (low, _) in m.items() if low > 0.0)
        targets = {(TARGET, name): SegmentValues(model.targets(name)) for name in shapes.averaged}
        self._targets = SegmentTable(model, targets)
        self._found: dict[tuple[str, str, float], Spans] = {}
        self._margin = model.reach + tuning.longest
        times = {t for s in segments for t in (s.start, s.end)} | {t for g in goals for t in (g.start, g.end)}
        self._knots = Knots(np.array(sorted(times), dtype=np.float64), STEP, self._margin)
        self.edges = self._knots.edges
        # Times asked for lie in one block and perhaps a little on both sides.
        self.block: Callable[[int], KnotBlock] = lru_cache(maxsize=3)(self._block)

    @cached_property
    def columns(self) -> SegmentTable:
        """What is averaged over the segments on the knots of blocks."""
        speaks = SegmentValues(np.array([float(s.phone != SILENCE) for s in self.segments]))
        names = sorted(set(self.alike.values()))
        lows = {
            (LOW, name): SegmentValues(self._everywhere(name)[0]) for name in names if name in self.raised
        }
        missing = {(MISSING, name): SegmentValues(self.missing(name)) for name in names}
        return SegmentTable(self.model, {**self._targets.values, (SPEAKS, JAW): speaks, **lows, **missing})

    @cached_property
    def alike(self) -> Mapping[str, str]:
        """The first of those that are limited as it is, by limited parameter: both sides are, mostly."""
        first: dict[tuple[object, ...], str] = {}
        pace = (self.tuning.min_onset, self.tuning.min_offset)
        return {
            name: first.setdefault(
                (self.model.group(name), self._held(name).tobytes(), *(least[name] for least in pace)), name
            )
            for name in sorted(self.limited)
        }

    def missing(self, name: str) -> Array:
        """Return what each segment's upper limit on a parameter leaves to 1, shape (segments,)."""
        return np.asarray(1.0 - self._everywhere(name)[1])

    def _everywhere(self, name: str) -> Array:
        """Return each segment's lower and upper limit on a parameter, else 0 and 1, shape (2, segments)."""
        return self._held(name)[:, self._shared.number]

    def _held(self, name: str) -> Array:
        """Return the same of each mapping that segments share, shape (2, mappings)."""
        return np.array([m.get(name, (0.0, 1.0)) for m in self._shared.mappings], dtype=np.float64).T

    def spoken_at(self, times: Array) -> Mapping[str, Array]:
        """Return the segments' own curves by parameter at sorted times, shape (n,) each."""
        return self.shapes.values(self.approach.reached(SegmentAverages(self._targets, times), times))

    def own_at(self, name: str, times: Array) -> Array:
        """Return the segments' own curve of a parameter at sorted times, shape (n,), by lines."""
        return self.interpolated(lambda block: block.own(name), times)

    def speaking_at(self, times: Array) -> Array:
        """Return how much the mouth speaks at sorted times, 0..1, shape (n,)."""
        return self.interpolated(KnotBlock.speaking, times)

    def low_at(self, name: str, times: Array) -> Array:
        """Return the lower limit of a parameter at sorted times, shape (n,)."""
        return self.interpolated(lambda block: block.low(name), times)

    def high_at(self, name: str, times: Array) -> Array:
        """Return the upper limit for channels that the lips outrank at sorted times, shape (n,)."""
        return self.interpolated(lambda block: block.high(name), times)

    def closed_at(self, name: str, times: Array) -> Array:
        """Return the upper limit that closures set for every channel at sorted times, shape (n,)."""
        return self.interpolated(lambda block: block.closed(name), times)

    def jaw_at_seal(self, times: Array) -> Array:
        """Return how far the jaw may be open, given the seals, at sorted times, shape (n,)."""
        return self.interpolated(KnotBlock.jaw_at_seal, times)

    def interpolated(self, curve: Callable[[KnotBlock], Array], times: Array) -> Array:
        """Return a curve given on the knots of each block, at sorted times, shape (n,)."""
        numbers = np.floor(times / BLOCK)
        values = np.empty(len(times))
        for number in np.unique(numbers):
            first, last = np.searchsorted(numbers, (number, number + 1))
            block = self.block(int(number))
            values[first:last] = np.interp(times[first:last], block.knots, curve(block))
        return values

    def block_at(self, time: float) -> KnotBlock:
        """Return the block in which a time lies."""
        return self.block(block_number(time))

    def above(self, name: str, threshold: float) -> Spans:
        """Return when the segments' own curve of a parameter is higher than `threshold`, shape (n, 2)."""
        return self._scan("above", name, threshold, lambda b, n, t: b.above(n, t))

    def forbidden(self, name: str, threshold: float, closures_only: bool) -> Spans:
        """Return when limits let others' contributions to a parameter not pass `threshold`, shape (n, 2)."""
        if name not in self.limited:
            return EMPTY
        if closures_only:
            return self._scan("closed", name, threshold, lambda b, n, t: b.below(b.closed(n), t))
        return self._scan("high", name, threshold, lambda b, n, t: b.below(b.high(n), t))

    def _scan(
        self, kind: str, name: str, threshold: float, find: Callable[[KnotBlock, str, float], Spans]
    ) -> Spans:
        """Look through all blocks, for every parameter that might be asked for, so that each is made once."""
        if (kind, name, threshold) not in self._found:
            others = self.shapes.parameters if kind == "above" else self.limited
            wanted = {(n, self.tuning.threshold[n]) for n in others if RIVALS[n]} | {(name, threshold)}
            found: dict[tuple[str, float], list[Spans]] = {key: [] for key in wanted}
            for number in range(block_number(self.edges[0]), block_number(self.edges[-1]) + 1):
                for key in sorted(wanted):
                    found[key].append(find(self.block(number), *key))
            self._found.update({(kind, *key): union(spans) for key, spans in found.items()})
        return self._found[kind, name, threshold]

    def _block(self, number: int) -> KnotBlock:
        return KnotBlock(self, block_knots(self._knots, number, self._margin))


class KnotBlock:
    """The knots of one block of time, shape (n,), and curves on them, made when first asked for.

    `kept`: what each channel keeps of each parameter (see `limits`).
    """

    def __init__(self, mouth: SpeechMouth, knots: Array) -> None:
        self.knots = knots
        self._mouth = mouth
        self._goals = tuple(g for g in mouth.goals if g.start <= knots[-1] and g.end >= knots[0])
        self._averages = SegmentAverages(mouth.columns, knots)
        self._curves: dict[tuple[str, str], Array] = {}
        self.kept: dict[tuple[str, str], Array] = {}

    def above(self, name: str, threshold: float) -> Spans:
        """Return when the segments' curve is higher than `threshold`: seen on knots, then refined."""
        threshold += HAIR
        high = self.own(name) > threshold
        edges = np.flatnonzero(high[1:] != high[:-1])
        crossings = np.zeros(0)
        if len(edges):
            crossings = find_roots(
                lambda t: self._mouth.spoken_at(t)[name] - threshold,
                self.knots[edges],
                self.knots[edges + 1],
            )
        return spans_between(self.knots, high, crossings)

    def below(self, curve: Array, threshold: float) -> Spans:
        """Return when a curve on the knots is not higher than `threshold`, shape (n, 2)."""
        return above_line(self.knots, -curve, -threshold - HAIR)

    def speaking(self) -> Array:
        """Return how much the mouth speaks at the knots, 0..1: the weight of all but silence."""
        return self._curve("speaking", JAW, lambda n: self._averages.of(SPEAKS, n))

    def low(self, name: str) -> Array:
        """Return the lower limit at the knots, 0 where there is none."""
        return self._curve("low", self._alike(name), lambda n: self._averages.of(LOW, n))

    def high(self, name: str) -> Array:
        """Return the upper limit at the knots for channels that the lips outrank, 1 where there is none."""
        return self._curve("high", self._alike(name), lambda n: self._envelope(n, self.limit(n)))

    def closed(self, name: str) -> Array:
        """Return the upper limit at the knots that closures set for every channel, 1 where there is none."""
        return self._curve("closed", self._alike(name), lambda n: self._envelope(n, self.closures(n)))

    def limit(self, name: str) -> Array:
        """Return the upper limit at the knots, as it is: not slowed around the phones that set it."""

        def make(name: str) -> Array:
            return np.minimum(1.0 - self._averages.of(MISSING, name), self.closures(name))

        return self._curve("limit", self._alike(name), make)

    def _alike(self, name: str) -> str:
        return self._mouth.alike.get(name, name)

    def own(self, name: str) -> Array:
        """Return the segments' own curve of a parameter at the knots: 0 where none of them moves it."""
        found = self._spoken.get(name)
        return np.zeros(len(self.knots)) if found is None else found

    @cached_property
    def _spoken(self) -> Mapping[str, Array]:
        reached = self._mouth.approach.reached(self._averages, self.knots)
        return self._mouth.shapes.values(reached)

    def limiting(self, name: str, time: float) -> int:
        """Return the number of the segment whose upper limit counts most at a time."""
        mouth, tuning = self._mouth, self._mouth.tuning
        missing = mouth.missing(name)
        limit = self.limit(name)
        ahead = self.knots - time
        pace = STEEPEST * np.where(ahead > 0.0, tuning.min_offset[name], tuning.min_onset[name])
        slack = np.divide(np.abs(ahead), pace, out=np.full(len(ahead), np.inf), where=pace > 0.0)
        binding = float(self.knots[np.argmin(limit + slack)])
        for goal in self._goals:
            if goal.start <= binding <= goal.end and missing[goal.segment] > 0.0:
                return goal.segment
        weights = mouth.model.weights(mouth.model.group(name), np.array([binding]))
        return int(weights.segment[np.argmax(weights.weight * missing[weights.segment])])

    def jaw_at_seal(self) -> Array:
        """Return how far the jaw may be open at the knots, given the seals."""

        def make(name: str) -> Array:
            limit = np.ones(len(self.knots))
            for goal in self._goals:
                if goal.contact == SEAL:
                    self._lower(limit, goal, 1.0 - goal.value * (1.0 - JAW_AT_SEAL))
            return self._envelope(name, limit)

        return self._curve("seal", JAW, make)

    def _curve(self, kind: str, name: str, make: Callable[[str], Array]) -> Array:
        found = self._curves.get((kind, name))
        if found is None:
            found = self._curves[kind, name] = make(name)
        return found

    def closures(self, name: str) -> Array:
        """Return the limits of closures alone: for the whole closure, and not diluted by neighbours."""
        limit = np.ones(len(self.knots))
        for goal in self._goals:
            held = self._mouth.limits[goal.segment].get(name)
            if held is not None:
                self._lower(limit, goal, held[1])
        return limit

    def _lower(self, limit: Array, goal: Goal, value: float) -> None:
        first = int(np.searchsorted(self.knots, goal.start, side="left"))
        last = int(np.searchsorted(self.knots, goal.end, side="right"))
        np.minimum(limit[first:last], value, out=limit[first:last])

    def _envelope(self, name: str, limit: Array) -> Array:
        """The highest curve below `limit` that keeps the parameter's minimum durations."""
        tuning = self._mouth.tuning
        return envelope(self.knots, limit, tuning.min_onset[name], tuning.min_offset[name])


def limits_in_force(segments: Sequence[LipSegment], goals: Sequence[Goal]) -> tuple[SegmentLimits, ...]:
    """Return the limits of each segment: none of silence, nor of one whose contact goals are switched off."""
    closing = {g.segment for g in goals}
    none: SegmentLimits = {}
    return tuple(
        s.limits if s.phone != SILENCE and (i in closing or not _touches(s)) else none
        for i, s in enumerate(segments)
    )


def _touches(segment: LipSegment) -> bool:
    return any(segment.targets.get(contact, 0.0) > 0.0 for contact in CONTACTS)
