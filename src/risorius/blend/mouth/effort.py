"""Lip segments blended with the least effort.

Each articulator follows the curve x that minimizes

    Σ ∫ w·(x - target)² dt + EFFORT·∫ (x″)² dt

with one integral per segment, over its window, and w the segment's precision. Outside all windows only the
effort counts. So a precise segment is reached even if it is short, and an imprecise one takes its neighbours'
shape: effort against precision (Šimko and Cummins 2010, "Embodied task dynamics"), windows as in Keating 1990
("The window model of coarticulation"). From one target to the next the curve turns in (EFFORT/w)^¼ seconds:
27 ms for w = 1, 17 ms for a labial's gap (facts: lips-motion, 2).

The curve is linear in the targets, and the shares of the segments sum to 1; a share may dip to -0.05 beside a
precise segment. It is found by finite elements: cubic pieces that join with their slope, on nodes at the ends
of the windows and at most `ELEMENT` apart; one banded system per group of parameters, with each value of the
segments as a right side.

What follows a pause does not bend the curve up to `HELD` before the pause: there it is the curve of segments
after which the mouth rests. So a part of the system has a stretch for each pause: the elements from `HELD`
before the one before it on.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.linalg import cho_solve_banded, cholesky_banded

from ...core.arrays import Array, IndexArray
from ...core.movement import LipSegment
from ...core.speech.utterance import SILENCE
from ..intervals import ranges
from ..knots import split_blocks, steps_between
from .coarticulation import LIP_MODELS, ParameterGroups, SegmentValues, SegmentWeights, SharedMappings

EFFORT = 5e-7
"""s⁴: the effort of an acceleration, relative to the precision of a vowel (1)."""
WINDOW = 0.8
"""The middle share of a segment in which its target counts."""
YIELDING = 0.06
"""Seconds at either end of a silence in which the lips are on their way to or from rest."""
ELEMENT = 0.015
"""Seconds, the longest element: a cubic on it is nearer than 0.001 of a step to the exact curve."""
NEAREST = 1e-4
"""Seconds: two nodes that are nearer become one."""
REST = 1e-9
"""The precision of rest at all times: if no segment holds an articulator, it rests."""
REACH = 1.0
"""Seconds after which a segment has no effect: 38 time constants of a vowel's turn."""
PAUSE, HELD, RESTED = 0.16, 0.5, 0.12
"""Seconds: the shortest pause without an in-breath that may be the end, longer than that of a comma; how long
before it the curve does not depend on what follows; how long a mouth rests that nothing follows."""
SHIFT, APART = 256.0, 100.0
"""Seconds from one stretch to the next in the elements of a part; how far apart their nodes are at least."""
PART = 32.0
"""Seconds: the curve is found in parts of so long, each with the segments within `REACH`: the value at a
time must not depend on which other times are requested."""
LONGEST = 30.0
"""Seconds beyond its part at which a window is cut."""
CACHED = 4
"""Parts that stay cached with the systems of their groups, .3 MB each: enough for a block of knots."""
SHARED = 16
"""Shares of all segments in a part that stay cached, which only explanations need."""
GRAIN = 2.0**-32
"""Values are whole multiples of this: a segment that is far away changes no bit, and rest is exactly 0."""

# Cubic Hermite elements: integrals of the products of the four shape functions, of their second derivatives,
# and of the functions themselves, on an element of length 1 (value and slope at its start, then at its end).
_MASS = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) / 420.0
_BENDING = np.array([[12.0, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
_LOAD = np.array([6.0, 1, 6, -1]) / 12.0


class _Windows(NamedTuple):
    """The windows of some segments, in the order of the segments; arrays of shape (segments,)."""

    start: Array
    end: Array


@dataclass(frozen=True, slots=True)
class _Elements:
    """The elements of one part.

    `near` (segments,): numbers of the segments with an effect there, stretch by stretch; `nodes` (n,): times;
    `segment`, `element` (m,): which of these segments has a window over which element; `length` (n - 1,)
    seconds; `bending` (4, 2 n): the lower bands of the effort. Up to `ends` (stretches,) the curve is that of
    each stretch, all of whose times are later by `shifts` (stretches,) seconds than they are. `between`
    (stretches - 1,): the numbers of the elements that would join two stretches, without weight or effort.
    """

    near: IndexArray
    nodes: Array
    segment: IndexArray
    element: IndexArray
    length: Array
    bending: Array
    ends: Array
    shifts: Array
    between: IndexArray


@dataclass(frozen=True, slots=True)
class _System:
    """The system of one group in one part, and its solutions so far.

    `precision` (segments,); `factor` (4, unknowns): its Cholesky factor, lower bands; `solutions`: the
    unknowns (unknowns,) for values of the segments.
    """

    elements: _Elements
    precision: Array
    factor: Array
    solutions: dict[SegmentValues, Array] = field(default_factory=dict)

    def solved(self, values: Sequence[SegmentValues]) -> list[Array]:
        """Return the unknowns for each of some values; if two threads need them, both compute them."""
        new = [value for value in values if value not in self.solutions]
        if new:
            unknowns = self.solve(np.stack([value[self.elements.near] for value in new]))
            self.solutions.update(zip(new, unknowns, strict=True))
        return [self.solutions[value] for value in values]

    def solve(self, values: Array) -> Array:
        """Return the unknowns for k values of each segment, (k, segments) -> (k, unknowns)."""
        loads = _loads(self.elements, self.precision * values)
        unknowns = cho_solve_banded((self.factor, True), loads.T, overwrite_b=True, check_finite=False)
        return np.asarray(unknowns.T)


class _Part(NamedTuple):
    """The elements of one part, and the systems of groups so far."""

    elements: _Elements
    systems: dict[int, _System]


class _Basis(NamedTuple):
    """Sorted times (n,) of one part: their `place` among others, and the cubics that are not 0 at each.

    `unknowns`: the numbers of the four unknowns that matter, (n,) each; `shapes`: how much each of them
    counts, likewise.
    """

    part: int
    place: slice
    unknowns: tuple[IndexArray, ...]
    shapes: tuple[Array, ...]

    def curve(self, solution: Array) -> Array:
        """Return the curve of a solution at the times, (unknowns,) or (k, unknowns) -> (n,) or (k, n)."""
        curve: Array = np.zeros(())
        for numbers, shape in zip(self.unknowns, self.shapes, strict=True):
            part = solution.take(numbers, axis=-1)
            part *= shape
            part += curve
            curve = part
        return curve


@LIP_MODELS.register("effort")
class EffortModel:
    """Coarticulation with the least effort (see `coarticulation.Coarticulation`)."""

    reach = REACH

    def __init__(self, segments: Sequence[LipSegment]) -> None:
        self._targets = SharedMappings([s.targets for s in segments])
        self._precisions = SharedMappings([s.precision for s in segments])
        self._first = self._precisions.first(segments)
        self._starts = np.array([s.start for s in segments])
        self._ended = np.maximum.accumulate(np.array([s.end for s in segments]))
        self._windows = _windows(segments)
        # Only of segments after which the mouth rests is it known how they end.
        self._pauses = _pauses(segments) if _is_silent(segments[-1]) else np.zeros(0, np.intp)
        self._groups = ParameterGroups(self._precision)
        self._part = lru_cache(maxsize=CACHED)(lambda part: _Part(self._elements_of(part), {}))
        self._shares = lru_cache(maxsize=SHARED)(self._shared)
        self._latest: tuple[Array, tuple[_Basis, ...]] | None = None

    def group(self, parameter: str) -> int:
        """Return the number of the group of parameters for which each segment has one precision."""
        return self._groups.number(parameter)

    def targets(self, parameter: str) -> Array:
        """Return each segment's target, 0 if it has none, shape (segments,)."""
        return self._targets.column(parameter, 0.0)

    def averages(self, group: int, values: Sequence[SegmentValues], times: Array) -> list[Array]:
        """Return the least-effort curve through each of some values at sorted times, shape (n,) each."""
        averages = np.empty((len(values), len(times)))
        for basis in self._bases(times):
            system = self._system(group, basis.part)
            for average, solution in zip(averages, system.solved(values), strict=True):
                average[basis.place] = basis.curve(solution)
        averages *= 1.0 / GRAIN
        np.rint(averages, out=averages)
        averages *= GRAIN
        return list(averages)

    def weights(self, group: int, times: Array) -> SegmentWeights:
        """Return the share of each segment at sorted times: the curve if its target is 1 and all others 0."""
        segments, places, shares = [], [], []
        for basis in self._bases(times):
            near, place = self._part(basis.part).elements.near, basis.place
            shares.append(basis.curve(self._shares(group, basis.part)).T.ravel())
            segments.append(np.tile(near, place.stop - place.start))
            places.append(np.repeat(np.arange(place.start, place.stop), len(near)))
        return SegmentWeights(
            np.concatenate(segments), np.concatenate(places), np.concatenate(shares), len(times)
        )

    def _precision(self, parameter: str) -> Array:
        return np.array([s.precision_of(parameter) for s in self._first])[self._precisions.number]

    def _bases(self, times: Array) -> tuple[_Basis, ...]:
        """Return the basis in each part that holds some of the sorted times; all groups share the latest."""
        latest = self._latest
        if latest is None or latest[0] is not times:
            bases = (
                _basis(part, place, self._part(part).elements, times[place])
                for part, place in split_blocks(times, PART)
            )
            latest = self._latest = (times, tuple(bases))
        return latest[1]

    def _system(self, group: int, number: int) -> _System:
        """Return the system of a group in a part; if two threads need it, both compute it."""
        part = self._part(number)
        system = part.systems.get(group)
        if system is None:
            system = part.systems[group] = self._system_of(group, part.elements)
        return system

    def _system_of(self, group: int, elements: _Elements) -> _System:
        precision = self._groups.rows[group][elements.near]
        matrix = _matrix(elements, precision)
        factor = cholesky_banded(matrix, overwrite_ab=True, lower=True, check_finite=False)
        return _System(elements, precision, factor)

    def _shared(self, group: int, part: int) -> Array:
        """Return the unknowns of a part, (segments, unknowns), for each segment alone at 1."""
        system = self._system(group, part)
        return system.solve(np.eye(len(system.precision)))

    def _elements_of(self, part: int) -> _Elements:
        """Return the elements of a part, and of `REACH` around it."""
        start, stop = part * PART, (part + 1) * PART
        # A window that goes on for long has no more elements than others: far from its ends nothing bends.
        felt = (start - LONGEST, stop + LONGEST)
        near: list[IndexArray] = []
        rests: list[tuple[int, float]] = []
        ends, reach = [], REACH
        for pause, end in self._ends_within(start, stop):
            numbers = self._near(start - reach, end + REACH)
            if pause is not None:
                # The mouth rests, as after all segments.
                numbers = np.append(numbers[: pause - numbers[0]], len(self._starts) - 1)
                rests.append((sum(map(len, near)) + len(numbers) - 1, self._starts[pause] + YIELDING))
            near.append(numbers)
            ends.append(end)
            start, reach = end, HELD
        numbers = np.concatenate(near)
        first, last = (np.clip(edges[numbers], *felt) for edges in self._windows)
        for place, rest in rests:
            first[place], last[place] = rest, rest + RESTED
        shifts = SHIFT * np.arange(len(near), dtype=np.float64)
        shifted = np.repeat(shifts, [len(own) for own in near])
        return _elements(numbers, first + shifted, last + shifted, np.array(ends), shifts)

    def _ends_within(self, start: float, stop: float) -> Iterator[tuple[int | None, float]]:
        """Yield the pauses by which a part is divided, and until when the curve does not depend on what
        follows each; in the end the part's end, with the next pause if that is near.
        """
        ends = self._starts[self._pauses] - HELD
        first, last = np.searchsorted(ends, (start, stop), side="right")
        yield from zip(self._pauses[first:last].tolist(), ends[first:last].tolist(), strict=True)
        near = last < len(ends) and ends[last] + HELD < stop + REACH
        yield int(self._pauses[last]) if near else None, stop

    def _near(self, start: float, end: float) -> IndexArray:
        """Return the numbers of the segments between two times, at least one."""
        begin = int(np.searchsorted(self._ended, start, side="left"))
        stop = int(np.searchsorted(self._starts, end, side="right"))
        begin = min(begin, len(self._starts) - 1)
        return np.arange(begin, max(stop, begin + 1))


def _pauses(segments: Sequence[LipSegment]) -> IndexArray:
    """Return the numbers of the silences after speech that may be its end."""
    numbers = [
        number
        for number, (before, segment) in enumerate(pairwise(segments), 1)
        if segment.phone == SILENCE != before.phone
        and (segment.targets or segment.end - segment.start >= PAUSE)
    ]
    return np.array(numbers, dtype=np.intp)


def _is_silent(segment: LipSegment) -> bool:
    return segment.phone == SILENCE and not segment.targets


def _windows(segments: Sequence[LipSegment]) -> _Windows:
    start, end = (np.array([getattr(s, name) for s in segments]) for name in ("start", "end"))
    silent = np.array([_is_silent(s) for s in segments])
    given_up = np.where(silent, YIELDING, 0.5 * (1.0 - WINDOW) * (end - start))
    return _Windows(start + given_up, np.maximum(end - given_up, start + given_up))


def _elements(near: IndexArray, start: Array, end: Array, ends: Array, shifts: Array) -> _Elements:
    """Return the elements for the windows of some segments, from `start` to `end`, shape (segments,) each.

    Those of each stretch are shifted by its `shifts` seconds.
    """
    edges = np.unique(np.concatenate((start, end)))
    edges = edges[np.append(True, np.diff(edges) > NEAREST)]
    if len(edges) == 1:
        edges = np.append(edges, edges + ELEMENT)
    width = np.diff(edges)
    counts = steps_between(edges, ELEMENT)
    counts[width > APART] = 1
    steps = np.arange(int(counts.sum())) - np.repeat(np.cumsum(counts) - counts, counts)
    nodes = np.append(np.repeat(edges[:-1], counts) + steps * np.repeat(width / counts, counts), edges[-1])
    first, last = (np.searchsorted(nodes, t + 0.5 * NEAREST, side="right") - 1 for t in (start, end))
    h = np.diff(nodes)
    between = np.flatnonzero(h > APART)
    h[between] = ELEMENT
    stiffness = h**-3
    stiffness[between] = 0.0
    segment, element = ranges(np.maximum(first, 0), np.maximum(last, 0))
    bending = EFFORT * _bands(_BENDING, stiffness, h)
    return _Elements(near, nodes, segment, element, h, bending, ends, shifts, between)


def _bands(local: Array, value: Array, h: Array) -> Array:
    """Return the lower bands (4, unknowns) of elements' matrices: `local` (4, 4) times `value` (elements,).

    An unknown slope counts in units of its element's length `h` (elements,).
    """
    bands = np.zeros((4, 2 * len(h) + 2))
    scaled = (value, value * h, value * h * h)
    for row in range(4):
        for column in range(row + 1):
            part = local[row, column] * scaled[row % 2 + column % 2]
            bands[row - column, column : column + 2 * len(h) : 2] += part
    return bands


def _matrix(elements: _Elements, precision: Array) -> Array:
    """Return the lower bands of the system, shape (4, unknowns)."""
    h = elements.length
    total = REST + np.bincount(elements.element, precision[elements.segment], len(h))
    total[elements.between] = 0.0
    return elements.bending + _bands(_MASS, total * h, h)


def _loads(elements: _Elements, pulls: Array) -> Array:
    """Return the right sides, (k, unknowns), for the segments' precision times value, (k, segments)."""
    h = elements.length
    loads = np.zeros((len(pulls), 2 * len(elements.nodes)))
    sizes = [_LOAD[row] * h ** (1 + row % 2) for row in range(4)]
    for load, own in zip(loads, pulls, strict=True):
        pull = np.bincount(elements.element, own[elements.segment], len(h))
        for row, size in enumerate(sizes):
            load[row : row + 2 * len(h) : 2] += pull * size
    return loads


def _basis(part: int, place: slice, elements: _Elements, times: Array) -> _Basis:
    """Return the basis at sorted times; curves are constant before the first and after the last node."""
    nodes, between = elements.nodes, elements.between
    stretch = np.searchsorted(elements.ends[:-1], times, side="left")
    first, last = np.append(0, between + 1), np.append(between, len(nodes) - 1)
    inside = np.clip(times + elements.shifts[stretch], nodes[first][stretch], nodes[last][stretch])
    element = np.searchsorted(nodes, inside, side="right") - 1
    element = np.minimum(element, last[stretch] - 1)
    h = elements.length[element]
    x = (inside - nodes[element]) / h
    shapes = (
        1.0 - x * x * (3.0 - 2.0 * x),
        h * x * (1.0 - x) ** 2,
        x * x * (3.0 - 2.0 * x),
        -h * x * x * (1.0 - x),
    )
    return _Basis(part, place, tuple(2 * element + number for number in range(len(shapes))), shapes)
