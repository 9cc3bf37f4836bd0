"""The mouth as speech needs it: the segments' own curves, and their limits on other channels.

All curves are computed on knots: times that divide every segment evenly, at most `STEP` apart, so that the
results do not depend on the frame rate and move with the segments. Between knots limits turn without
corners (`smooth_interp`). Knots are computed in blocks of time, so that memory does not grow with the score.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache, cached_property, lru_cache, partial
from operator import is_
from typing import NamedTuple

import numpy as np

from ...core.arrays import Array
from ...core.movement import LipSegment
from ...core.parameters import RIVALS
from ...core.speech.utterance import SILENCE
from ..intervals import EMPTY, Spans, above_line, spans_between, union
from ..knots import (
    BLOCK,
    STEEPEST,
    Knots,
    KnotWindow,
    block_knots,
    block_number,
    envelope,
    smooth_interp,
    split_blocks,
)
from ..priority_curve import PriorityCurve
from ..roots import find_roots
from ..tuning import Tuning
from .closure_speed import ClosureSpeedLimit
from .coarticulation import (
    TARGET,
    Coarticulation,
    SegmentAverages,
    SegmentTable,
    SegmentValues,
    SharedMappings,
)
from .contact import CONTACTS, SEAL, Goal
from .shapes import Shapes

STEP = 0.005
"""Seconds between knots at most."""
HAIR = 1e-9
"""A limit or average that equals a threshold up to rounding is not above it."""
SegmentLimits = Mapping[str, tuple[float, float]]
"""The lower and upper limit of each parameter that a segment limits."""
JAW = "masseter"
JAW_AT_SEAL = 0.2
"""The most that the jaw may be open while the lips are sealed."""
ROUNDED = 0.02
"""Seconds over which a limit turns from falling to rising, so that the jaw shows no corner."""
SPEAKS, LOW, MISSING = "speaks", "low", "missing"
"""Averaged besides targets: 1 except for silence; a lower limit; 1 minus an upper limit."""


class SpeechMouth:
    """The mouth as the lip segments of a score need it.

    `segments`: sorted, without gaps, at least one; `limits`: the limits in force of each. `model`, `shapes`
    and `goals` (the contact goals in force) are those of the segments as a head performs them.
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
        self.approach = ClosureSpeedLimit(goals)
        self.tuning = tuning
        self.limits = tuple(limits)
        self._shared = SharedMappings(self.limits)
        self.limited = frozenset(name for limits in self._shared.mappings for name in limits)
        self.raised = frozenset(n for m in self._shared.mappings for n, (low, _) in m.items() if low > 0.0)
        targets = {(TARGET, name): SegmentValues(model.targets(name)) for name in shapes.averaged}
        self._targets = SegmentTable(model, targets)
        self._scanned: dict[tuple[str, str, float], Spans] = {}
        self._margin = model.reach + tuning.longest
        times = {t for s in segments for t in (s.start, s.end)} | {t for g in goals for t in (g.start, g.end)}
        self._knots = Knots(np.array(sorted(times), dtype=np.float64), STEP, self._margin)
        self.edges = self._knots.edges
        # Callers ask for times of one block, and sometimes a little more on both sides.
        self.block: Callable[[int], KnotBlock] = lru_cache(maxsize=3)(self._block)

    @cached_property
    def columns(self) -> SegmentTable:
        """All values of segments that are averaged on the knots."""
        speaks = SegmentValues(np.array([float(s.phone != SILENCE) for s in self.segments]))
        names = sorted(set(self.alike.values()))
        lows = {
            (LOW, name): SegmentValues(self._everywhere(name)[0]) for name in names if name in self.raised
        }
        missing = {(MISSING, name): SegmentValues(self.missing(name)) for name in names}
        return SegmentTable(self.model, {**self._targets.values, (SPEAKS, JAW): speaks, **lows, **missing})

    @cached_property
    def alike(self) -> Mapping[str, str]:
        """For each limited parameter, the first parameter with the same limits, most often its left side."""
        first: dict[tuple[object, ...], str] = {}
        pace = (self.tuning.min_onset, self.tuning.min_offset)
        return {
            name: first.setdefault(
                (self.model.group(name), self._limits_of(name).tobytes(), *(least[name] for least in pace)),
                name,
            )
            for name in sorted(self.limited)
        }

    def missing(self, name: str) -> Array:
        """Return 1 minus each segment's upper limit on a parameter, shape (segments,)."""
        return np.asarray(1.0 - self._everywhere(name)[1])

    def _everywhere(self, name: str) -> Array:
        """Return each segment's lower and upper limit on a parameter, else 0 and 1, shape (2, segments)."""
        return self._limits_of(name)[:, self._shared.number]

    def _limits_of(self, name: str) -> Array:
        """Return the same for each mapping of limits that segments share, shape (2, mappings)."""
        return np.array([m.get(name, (0.0, 1.0)) for m in self._shared.mappings], dtype=np.float64).T

    def spoken_at(self, times: Array) -> Mapping[str, Array]:
        """Return the segments' own curves by parameter at sorted times, shape (n,) each."""
        return self.shapes.values(self.approach.reached(SegmentAverages(self._targets, times), times))

    def own_at(self, name: str, times: Array) -> Array:
        """Return the segments' own curve of a parameter at sorted times, shape (n,), by straight lines."""
        return self.interpolated(lambda block: block.own(name), times, np.interp)

    def speaking_at(self, times: Array) -> Array:
        """Return how much the mouth speaks at sorted times, 0..1, shape (n,)."""
        return self.interpolated(KnotBlock.speaking, times)

    def low_at(self, name: str, times: Array) -> Array:
        """Return the lower limit of a parameter at sorted times, shape (n,)."""
        return self.interpolated(lambda block: block.low(name), times)

    def high_at(self, name: str, times: Array) -> Array:
        """Return the upper limit for channels of lower priority than speech, at sorted times, shape (n,)."""
        return self.interpolated(lambda block: block.high(name), times)

    def closed_at(self, name: str, times: Array) -> Array:
        """Return the upper limit that closures set for every channel, at sorted times, shape (n,)."""
        return self.interpolated(lambda block: block.closed(name), times)

    def jaw_at_seal(self, times: Array) -> Array:
        """Return how far the jaw may be open under the seals, at sorted times, shape (n,)."""
        return self.interpolated(KnotBlock.jaw_at_seal, times)

    def interpolated(
        self,
        curve: Callable[[KnotBlock], Array],
        times: Array,
        between: Callable[[Array, Array, Array], Array] = smooth_interp,
    ) -> Array:
        """Return at sorted times, shape (n,), a curve that is known on the knots of each block."""
        values = np.empty(len(times))
        for number, place in split_blocks(times, BLOCK):
            block = self.block(number)
            values[place] = between(times[place], block.knots, curve(block))
        return values

    def block_at(self, time: float) -> KnotBlock:
        """Return the block in which a time lies."""
        return self.block(block_number(time))

    def above(self, name: str, threshold: float) -> Spans:
        """Return when the segments' own curve of a parameter is higher than `threshold`, shape (n, 2)."""
        return self._scan("above", name, threshold, lambda b, n, t: b.above(n, t))

    def forbidden(self, name: str, threshold: float, closures_only: bool) -> Spans:
        """Return when limits keep other channels below `threshold` in a parameter, shape (n, 2)."""
        if name not in self.limited:
            return EMPTY
        if closures_only:
            return self._scan("closed", name, threshold, lambda b, n, t: b.below(b.closed(n), t))
        return self._scan("high", name, threshold, lambda b, n, t: b.below(b.high(n), t))

    def _scan(
        self, kind: str, name: str, threshold: float, find: Callable[[KnotBlock, str, float], Spans]
    ) -> Spans:
        """Search all blocks for all parameters that may be needed, so that each block is computed once."""
        if (kind, name, threshold) not in self._scanned:
            others = self.shapes.parameters if kind == "above" else self.limited
            keys = {(n, self.tuning.threshold[n]) for n in others if RIVALS[n]} | {(name, threshold)}
            spans: dict[tuple[str, float], list[Spans]] = {key: [] for key in keys}
            for number in range(block_number(self.edges[0]), block_number(self.edges[-1]) + 1):
                for key in sorted(keys):
                    spans[key].append(find(self.block(number), *key))
            self._scanned.update({(kind, *key): union(sets) for key, sets in spans.items()})
        return self._scanned[kind, name, threshold]

    def _block(self, number: int) -> KnotBlock:
        return KnotBlock(self, block_knots(self._knots, number, min(self._margin, BLOCK)))


class RequestShare(NamedTuple):
    """The share of its request that a channel gets of a parameter at a block's knots: `values` (n,).

    Of which request it is, `curves` tell, and the priorities of the channel and of speech, `levels`. A plan
    beside an earlier one has the same block, but perhaps other channels.
    """

    curves: tuple[object, ...]
    levels: tuple[PriorityCurve, PriorityCurve]
    values: Array

    def serves(self, curves: Sequence[object], levels: tuple[PriorityCurve, PriorityCurve]) -> bool:
        """Return whether it is the share of these curves with these priorities."""
        alike = len(curves) == len(self.curves) and all(map(is_, curves, self.curves))
        return alike and all(map(PriorityCurve.equal, self.levels, levels))


class KnotBlock:
    """The knots of one block of time, shape (n,), and curves on them, computed when first needed.

    `shares`: the share of its request that each channel gets of each parameter (`limits`). `around`: the
    knots within a given number of seconds around each knot.
    """

    def __init__(self, mouth: SpeechMouth, knots: Array) -> None:
        self.knots = knots
        self._mouth = mouth
        self._goals = tuple(g for g in mouth.goals if g.start <= knots[-1] and g.end >= knots[0])
        # One knot more to either side: between the knots curves turn about them (`smooth_interp`).
        first = np.searchsorted(knots, [g.start for g in self._goals], side="left") - 1
        last = np.searchsorted(knots, [g.end for g in self._goals], side="right") + 1
        first = np.maximum(first, 0)
        self._places = [slice(*ends) for ends in zip(first.tolist(), last.tolist(), strict=True)]
        self._averages = SegmentAverages(mouth.columns, knots)
        self._curves: dict[tuple[str, str], Array] = {}
        self.shares: dict[tuple[str, str], RequestShare] = {}
        self.around: Callable[[float], KnotWindow] = cache(partial(KnotWindow, knots))

    def above(self, name: str, threshold: float) -> Spans:
        """Return when the segments' curve is higher than `threshold`: searched on knots, then refined."""
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
        """Return the lower limit at the knots, else 0."""
        return self._curve("low", self._alike(name), lambda n: self._averages.of(LOW, n))

    def high(self, name: str) -> Array:
        """Return the upper limit at the knots for channels of lower priority than speech, else 1."""
        return self._curve("high", self._alike(name), lambda n: self._envelope(n, self.limit(n)))

    def closed(self, name: str) -> Array:
        """Return the upper limit at the knots that closures set for every channel, else 1."""
        return self._curve("closed", self._alike(name), lambda n: self._envelope(n, self.closures(n)))

    def limit(self, name: str) -> Array:
        """Return the upper limit at the knots before it is slowed around the phones that set it."""

        def make(name: str) -> Array:
            return np.minimum(1.0 - self._averages.of(MISSING, name), self.closures(name))

        return self._curve("limit", self._alike(name), make)

    def _alike(self, name: str) -> str:
        return self._mouth.alike.get(name, name)

    def own(self, name: str) -> Array:
        """Return the segments' own curve of a parameter at the knots, 0 if no segment moves it."""
        curve = self._spoken.get(name)
        return np.zeros(len(self.knots)) if curve is None else curve

    @cached_property
    def _spoken(self) -> Mapping[str, Array]:
        reached = self._mouth.approach.reached(self._averages, self.knots)
        return self._mouth.shapes.values(reached)

    def limiting(self, name: str, time: float) -> int:
        """Return the number of the segment whose upper limit is decisive at a time."""
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
        """Return how far the jaw may be open at the knots under the seals."""

        def make(name: str) -> Array:
            limit = np.ones(len(self.knots))
            for goal, place in zip(self._goals, self._places, strict=True):
                if goal.contact == SEAL:
                    _lower(limit[place], 1.0 - goal.value * (1.0 - JAW_AT_SEAL))
            around = self.around(ROUNDED)
            return around.average(around.lowest(self._envelope(name, limit)))

        return self._curve("seal", JAW, make)

    def _curve(self, kind: str, name: str, make: Callable[[str], Array]) -> Array:
        curve = self._curves.get((kind, name))
        if curve is None:
            curve = self._curves[kind, name] = make(name)
        return curve

    def closures(self, name: str) -> Array:
        """Return the limits of closures alone: each holds during its whole closure."""
        limit = np.ones(len(self.knots))
        for goal, place in zip(self._goals, self._places, strict=True):
            limits = self._mouth.limits[goal.segment].get(name)
            if limits is not None:
                _lower(limit[place], limits[1])
        return limit

    def _envelope(self, name: str, limit: Array) -> Array:
        """Return the highest curve below `limit` that respects the parameter's minimum durations."""
        tuning = self._mouth.tuning
        return envelope(self.knots, limit, tuning.min_onset[name], tuning.min_offset[name])


def _lower(limit: Array, value: float) -> None:
    """Make a limit `value` at most, in place."""
    np.minimum(limit, value, out=limit)


def limits_in_force(segments: Sequence[LipSegment], goals: Sequence[Goal]) -> tuple[SegmentLimits, ...]:
    """Return the limits of each segment; silence has none, nor a closure whose goal is switched off."""
    closing = {g.segment for g in goals}
    none: SegmentLimits = {}
    return tuple(
        s.limits if s.phone != SILENCE and (i in closing or not _touches(s)) else none
        for i, s in enumerate(segments)
    )


def _touches(segment: LipSegment) -> bool:
    return any(segment.targets.get(contact, 0.0) > 0.0 for contact in CONTACTS)
