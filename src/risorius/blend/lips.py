"""The lip segments of a score, compiled: their curves, their goals, and what they ask of other channels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

import numpy as np

from ..core.arrays import Array, IndexArray
from ..core.articulators import ARTICULATORS
from ..core.lip_rig import LipRig
from ..core.movement import LipSegment
from ..core.parameters import PARAMETERS, Kind
from ..core.score import Score
from ..core.utterance import SILENCE
from ..errors import InputError
from .coarticulation import LIP_MODELS, without_gaps
from .concatenate import SIGNED
from .contact import CONTACTS, GoalCurve, contact_goals
from .intervals import Extent, Spans, merged
from .mouth import SpeechMouth, limits_in_force
from .shapes import Shapes, performed
from .tuning import Tuning

_MOUTH = frozenset(p.name for p in PARAMETERS if p.kind in (Kind.MUSCLE, Kind.TONGUE, Kind.CONTACT))


_GRIDS = 3
"""Sets of times whose curves are kept: policies sample at theirs between the parameters of a caller's."""


class CompiledLips:
    """All that a score's lip segments do.

    `parameters`: those that some segment targets, contacts apart; `goals`: the curve of each contact;
    `speech`: when there are segments that are not silent, shape (n, 2).
    """

    def __init__(self, score: Score, tuning: Tuning, rig: LipRig | None) -> None:
        _check(score)
        given = without_gaps(score.lips)
        segments = performed(given, rig)
        self.model = LIP_MODELS.get(score.settings.lips)(segments)
        shapes = Shapes(segments, rig, score.settings.contact)
        self.parameters = shapes.parameters
        goals = contact_goals(segments) if score.settings.contact else ()
        self.goals = {name: GoalCurve([g for g in goals if g.contact == name]) for name in CONTACTS}
        self.mouth = SpeechMouth(given, limits_in_force(segments, goals), self.model, shapes, goals, tuning)
        spoken = [(s.start, s.end) for s in segments if s.phone != SILENCE]
        self.speech = merged(np.array(spoken, dtype=np.float64).reshape(-1, 2))
        self._sampled: tuple[tuple[Array, Mapping[str, Array]], ...] = ()

    def at(self, parameter: str, times: Array) -> Array:
        """Return the segments' curve of a parameter at sorted times, shape (n,)."""
        for known, values in self._sampled:
            if known is times:
                return values[parameter]
        values = self.mouth.spoken_at(times)
        # A new tuple: another thread may look at the old one meanwhile.
        self._sampled = (*self._sampled[1 - _GRIDS :], (times, values))
        return values[parameter]

    @cached_property
    def alone(self) -> Mapping[str, Array]:
        """What each segment would do by itself, by parameter, shape (segments,)."""
        return self.mouth.shapes.values(self.model.targets)


class LipCurve:
    """One parameter of the lip segments."""

    def __init__(self, lips: CompiledLips, parameter: str) -> None:
        self._lips, self._parameter = lips, parameter

    def sample(self, times: Array) -> tuple[IndexArray, Array]:
        """Return where the curve is not at rest and its values there (see StrokeCurve.sample)."""
        values = self._lips.at(self._parameter, times)
        index = np.flatnonzero(values)
        return index, values[index]

    def lines(self, times: Array) -> tuple[IndexArray, Array]:
        """Return what `sample` returns, to what lines over 5 ms leave out."""
        values = self._lips.mouth.own_at(self._parameter, times)
        index = np.flatnonzero(values)
        return index, values[index]

    def above(self, threshold: float) -> Spans:
        """Return when the curve is higher than `threshold`, shape (n, 2)."""
        return self._lips.mouth.above(self._parameter, threshold)

    def origin(self, time: float) -> LipSegment:
        """Return the segment that counts most at a time."""
        model = self._lips.model
        weights = model.weights(model.group(self._parameter), np.array([time]))
        worth = weights.weight * (1e-9 + self._lips.alone[self._parameter][weights.segment])
        return self._lips.mouth.segments[int(weights.segment[np.argmax(worth)])]

    def extents(self) -> Iterator[Extent]:
        """Yield nothing: the segments are compared as a whole."""
        return iter(())

    def breakpoints(self) -> Array:
        """Return all starts and ends of segments."""
        return self._lips.mouth.edges


def _check(score: Score) -> None:
    for segment in score.lips:
        for name in {*segment.targets, *segment.limits} - set(ARTICULATORS):
            if name in SIGNED or name not in _MOUTH:
                raise InputError(
                    f"phone '{segment.phone}' at {segment.start:g} s: lips cannot move {name}; "
                    "expected an articulator, a muscle, a contact or the tongue"
                )
