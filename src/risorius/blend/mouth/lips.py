"""The lip segments of a score, compiled: their curves, contact goals and limits on other channels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

import numpy as np

from ...core.arrays import Array, IndexArray
from ...core.lips.articulators import ARTICULATORS
from ...core.lips.lip_rig import RAISER, LipRig
from ...core.movement import Dominance, LipSegment
from ...core.parameters import BASES, PARAMETERS, Kind
from ...core.score import Score
from ...core.speech.utterance import SILENCE
from ...errors import InputError
from ..concatenate import SIGNED
from ..intervals import Extent, Spans, merged
from ..tuning import Tuning
from .coarticulation import LIP_MODELS, without_gaps
from .contact import CONTACTS, GoalCurve, contact_goals
from .shapes import Shapes, performed
from .speech_mouth import SpeechMouth, limits_in_force

_MOUTH = frozenset(p.name for p in PARAMETERS if p.kind in (Kind.MUSCLE, Kind.TONGUE, Kind.CONTACT))


_GRIDS = 4
"""Sets of times whose curves stay cached: those of a caller, those around them, and those of policies."""


class CompiledLips:
    """All that a score's lip segments do.

    `parameters`: all that some segment targets, except contacts that are goals; `goals`: the curve of each
    contact; `speech`: the times of segments that are not silent, shape (n, 2).
    """

    def __init__(self, score: Score, tuning: Tuning, rig: LipRig | None) -> None:
        _check(score)
        segments = without_gaps(score.lips)
        performing = performed(segments, rig)
        self.model = LIP_MODELS.get(score.settings.lips)(performing)
        shapes = Shapes(performing, rig, score.settings.contact)
        self.parameters = shapes.parameters
        goals = contact_goals(performing) if score.settings.contact else ()
        self.goals = {name: GoalCurve([g for g in goals if g.contact == name]) for name in CONTACTS}
        self.mouth = SpeechMouth(
            segments, limits_in_force(performing, goals), self.model, shapes, goals, tuning
        )
        spoken = [(s.start, s.end) for s in performing if s.phone != SILENCE]
        self.speech = merged(np.array(spoken, dtype=np.float64).reshape(-1, 2))
        self._sampled: tuple[tuple[Array, Mapping[str, Array]], ...] = ()

    def at(self, parameter: str, times: Array) -> Array:
        """Return the segments' curve of a parameter at sorted times, shape (n,)."""
        for known, values in self._sampled:
            if known is times:
                return values[parameter]
        values = self.mouth.spoken_at(times)
        # A new tuple, because another thread may read the old one meanwhile.
        self._sampled = (*self._sampled[1 - _GRIDS :], (times, values))
        return values[parameter]

    def alike(self, one: str, two: str) -> bool:
        """Return whether the segments move two sides of a muscle alike, as all articulators do."""
        if one not in self.parameters and two not in self.parameters:
            return True
        return self.mouth.shapes.by_rig(one) and self.mouth.shapes.by_rig(two)

    @cached_property
    def harmless(self) -> frozenset[str]:
        """The muscles that raise the upper lip for its part in the lips' opening: they inhibit no display.

        The pairs of paper A, Table 2 are muscles that pull against each other; a smiling mouth says /a/ with
        both. A score that names the muscle itself keeps the conflict.
        """
        return frozenset(p.name for p in BASES[RAISER] if self.mouth.shapes.by_rig(p.name))

    @cached_property
    def alone(self) -> Mapping[str, Array]:
        """The value that each segment has without neighbours, by parameter, shape (segments,)."""
        return self.mouth.shapes.values(self.model.targets)


class LipCurve:
    """One parameter of the lip segments."""

    def __init__(self, lips: CompiledLips, parameter: str) -> None:
        self._lips, self._parameter = lips, parameter

    def sample(self, times: Array) -> tuple[IndexArray, Array]:
        """Return the times at which the curve is not at rest, and its values (see MovementCurve.sample)."""
        values = self._lips.at(self._parameter, times)
        index = np.flatnonzero(values)
        return index, values[index]

    def lines(self, times: Array) -> tuple[IndexArray, Array]:
        """Return the values of `sample`, approximated by straight lines over 5 ms."""
        values = self._lips.mouth.own_at(self._parameter, times)
        index = np.flatnonzero(values)
        return index, values[index]

    def above(self, threshold: float) -> Spans:
        """Return when the curve is higher than `threshold`, shape (n, 2)."""
        return self._lips.mouth.above(self._parameter, threshold)

    def origin(self, time: float) -> LipSegment:
        """Return the segment with the largest share of the value at a time."""
        model = self._lips.model
        weights = model.weights(model.group(self._parameter), np.array([time]))
        worth = weights.weight * (1e-9 + self._lips.alone[self._parameter][weights.segment])
        return self._lips.mouth.segments[int(weights.segment[np.argmax(worth)])]

    def extents(self) -> Iterator[Extent]:
        """Yield nothing: two plans compare their segments as a whole."""
        return iter(())

    def breakpoints(self) -> Array:
        """Return all starts and ends of segments."""
        return self._lips.mouth.edges


def _check(score: Score) -> None:
    # Segments of one class share their mappings.
    for segment in {id(s.dominance): s for s in score.lips}.values():
        for dominance in segment.dominance.values():
            _check_dominance(segment, dominance)
    for segment in {id(s.precision): s for s in score.lips}.values():
        _check_precision(segment)
    for segment in score.lips:
        for name in {*segment.targets, *segment.limits} - set(ARTICULATORS):
            if name in SIGNED or name not in _MOUTH:
                raise InputError(
                    f"phone '{segment.phone}' at {segment.start:g} s: lips cannot move {name}; "
                    "expected an articulator, a muscle, a contact or the tongue"
                )


def _check_dominance(segment: LipSegment, d: Dominance) -> None:
    values = (d.magnitude, d.before, d.after, d.exponent, d.plateau)
    if not (all(0.0 <= v < float("inf") for v in values) and d.exponent > 0.0 and d.plateau <= 1.0):
        raise InputError(
            f"phone '{segment.phone}' at {segment.start:g} s: dominance {d} is out of range; expected "
            "magnitude, before, after of 0 or more, exponent above 0, plateau 0 to 1"
        )


def _check_precision(segment: LipSegment) -> None:
    for name, value in segment.precision.items():
        if not 0.0 <= value < float("inf"):
            raise InputError(
                f"phone '{segment.phone}' at {segment.start:g} s: precision of {name} = {value} is out of "
                "range; expected 0 or more"
            )
