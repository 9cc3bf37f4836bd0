"""From a score to curves: the page on which all parts of the combination meet.

Movements of a layer are concatenated, lip segments blended, channels settled against each other by the
policy, brought within the lips' limits and joined; the jaw shares, directions add, contact goals come last.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np

from ..core.arrays import Array, IndexArray
from ..core.lip_rig import OPENING, LipRig
from ..core.movement import CHANNEL_PRIORITY
from ..core.parameters import INDEX, NAMES, NEUTRAL
from ..core.performance import Performance, frame_times
from ..core.score import Score, check_score
from . import dominance, lookahead, policies  # noqa: F401 - they register themselves
from .approach import Parted
from .channels import Channel, compile_channels
from .coarticulation import LIP_MODELS
from .concatenate import SIGNED
from .conflict import POLICIES, Join, PolicyInputs
from .contact import CONTACTS, SEAL, TUCK, beside_tuck
from .curve import Curve
from .directions import combine_directions
from .knots import BLOCK
from .levels import steady
from .limits import LIPS, SpeechLimits
from .lips import CompiledLips
from .mouth import JAW, SpeechMouth
from .tuning import tune

CHUNK = 16_384
"""Times worked at once: memory beyond the result does not grow with its length."""


class Plan:
    """A score made ready: its curves at any times, on the head whose `rig` performs its articulators.

    `like` is the plan of a score with other movements: the work on its lips is taken over where they and the
    settings are the same. Raises as `check_score` and `tune` do, and InputError where lips need a rig and
    there is none.
    """

    def __init__(self, score: Score, rig: LipRig | None = None, like: Plan | None = None) -> None:
        check_score(score)
        policy = POLICIES.get(score.settings.conflict)
        LIP_MODELS.get(score.settings.lips)
        self.score, self.rig = score, rig
        self.tuning = tune(score.settings)
        self.lips: CompiledLips | None
        if like is not None and like.rig is rig and _speak_alike(like.score, score):
            self.lips = like.lips
        else:
            self.lips = CompiledLips(score, self.tuning, rig) if score.lips else None
        self.channels = compile_channels(score, self.lips)
        levels = next((c.levels for c in self.channels if c.name == LIPS), steady(CHANNEL_PRIORITY[LIPS]))
        self.limits = SpeechLimits(self.lips.mouth, levels) if self.lips else None
        self.inputs = PolicyInputs(self.channels, self.tuning, self.limits)
        self.policy = policy(self.inputs)
        limited = self.lips.mouth.limited if self.lips else frozenset()
        contacts = CONTACTS if self.lips else ()
        self.moving = sorted({*(n for c in self.channels for n in c.curves), *limited, *contacts})

    def at(self, times: Array) -> Array:
        """Return all parameters at the times, seconds, in any order, shape (n,) -> (n, 46)."""
        wanted = np.asarray(times, dtype=np.float64)
        order = np.argsort(wanted, kind="stable")
        values = np.empty((len(wanted), len(NAMES)))
        for piece in _chunks(wanted[order]):
            values[order[piece]] = Moment(self, wanted[order[piece]]).values()
        return values

    def performance(self, fps: Fraction) -> Performance:
        """Return the performance at frames k/fps, k = 0 … round(duration·fps)."""
        return Performance(self.score, fps, self.at(frame_times(self.score.duration, fps)))

    def performance_like(self, other: Performance, span: tuple[float, float]) -> Performance:
        """Return the performance at the frames of another that is the same outside `span`, seconds."""
        times, values = other.times, other.values.copy()
        here = slice(*np.searchsorted(times, span).tolist())
        if here.start < here.stop:
            values[here] = self.at(times[here])
        return Performance(self.score, other.fps, values)

    def adds(self, name: str) -> bool:
        """Return whether channels add up in a parameter; else the highest wins."""
        return self.policy.join is Join.SUM or name in SIGNED or (name == JAW and self.lips is not None)

    def batches(self, times: Array) -> Iterator[Array]:
        """Yield sorted times in batches that lie in one block and are not too long."""
        for chosen in _chunks(times):
            yield times[chosen]


def _speak_alike(a: Score, b: Score) -> bool:
    """Whether the lips of two scores are the same, and so is all that they are compiled by."""
    chosen = (replace(s.settings, conflict="", onset_function=None) for s in (a, b))
    return len(set(chosen)) == 1 and (a.lips is b.lips or a.lips == b.lips)


def _chunks(times: Array) -> Iterator[slice]:
    edges = np.flatnonzero(np.diff(np.floor(times / BLOCK))) + 1
    for first, last in pairwise((0, *edges.tolist(), len(times))):
        for start in range(first, last, CHUNK):
            yield slice(start, min(start + CHUNK, last))


class Moment:
    """A plan at some sorted times of one block, shape (n,), at least one."""

    def __init__(self, plan: Plan, times: Array) -> None:
        self.plan, self.times = plan, times
        self.resolve = plan.policy.at(times)
        self._limits = plan.limits
        self._mouth = plan.lips.mouth if plan.lips else None
        self._values: dict[str, Array] = {}

    def values(self) -> Array:
        """Return all parameters, shape (n, 46)."""
        values = np.tile(NEUTRAL, (len(self.times), 1))
        for name in self.plan.moving:
            values[:, INDEX[name]] = self.value(name)
        return values

    def value(self, name: str) -> Array:
        """Return one parameter, shape (n,)."""
        if name not in self._values:
            self._values[name] = self._value(name)
        return self._values[name]

    def _value(self, name: str) -> Array:
        if name in SIGNED:
            terms = [term for _, term in self.terms(name)]
            return combine_directions(name, terms or [np.zeros(len(self.times))])
        own = self.own(name)
        total = self._join_all(name, own)
        if name == JAW and self._mouth is not None:
            return np.minimum(total, self._mouth.jaw_at_seal(self.times))
        return self.touched(name, total) if name in CONTACTS else total

    def own(self, name: str) -> Array:
        """Return what speech does with a parameter, settled, shape (n,)."""
        dense = np.zeros(len(self.times))
        for channel in self.plan.channels:
            if channel.name == LIPS and name in channel.curves:
                index, values = self.resolved(channel, name)
                dense[index] = values
        return dense

    def resolved(self, channel: Channel, name: str) -> tuple[IndexArray, Array]:
        """Return where a channel moves a parameter and what the policy leaves of it, both shape (m,)."""
        index, values = channel.sample(name, self.times)
        return index, self.resolve(channel, name, self.times[index], values)

    def bounded(self, channel: Channel, name: str, index: IndexArray, resolved: Array, own: Array) -> Array:
        """Return what is left of another channel's settled values, at the indices, under speech, (m,)."""
        return self.limited(channel, name, index, self.shared(channel, name, index, resolved, own), own)

    def shared(self, channel: Channel, name: str, index: IndexArray, values: Array, own: Array) -> Array:
        """Return another channel's values, the jaw's as what it adds to the jaw of speech, shape (m,)."""
        if name != JAW or self._limits is None:
            return values
        return values * self._limits.jaw_share(channel, self.times[index], own[index])

    def limited(self, channel: Channel, name: str, index: IndexArray, values: Array, own: Array) -> Array:
        """Return another channel's values within the limits of speech, shape (m,)."""
        if self._limits is None:
            return values
        return self._limits.applied(channel, name, self.times[index], values, own[index])

    def _join_all(self, name: str, own: Array) -> Array:
        """Speech and all other channels together, 0..1."""
        adds = self.plan.policy.join is Join.SUM
        others = np.zeros(len(self.times))
        for channel in self.plan.channels:
            if channel.name == LIPS or name not in channel.curves:
                continue
            index, values = self.resolved(channel, name)
            values = self.bounded(channel, name, index, values, own)
            others[index] = others[index] + values if adds else np.maximum(others[index], values)
        total = own + others if self.plan.adds(name) else np.maximum(own, others)
        if self._mouth is not None and name in self._mouth.raised:
            total = np.maximum(total, self._mouth.low_at(name, self.times))
        return np.minimum(total, 1.0)

    def touched(self, name: str, value: Array) -> Array:
        """Return a contact, shape (n,), with its goals; one that is a goal pushes the other aside.

        A seal's goal closes what is left open beyond the way to the closure (`approach`), so that the gap
        goes no faster where it sets in. A tuck leaves it `beside_tuck`.
        """
        lips = self.plan.lips
        if lips is None:
            return value
        tuck = lips.goals[TUCK].at(self.times)
        if name == TUCK:
            return np.minimum(np.maximum(value, tuck), 1.0 - lips.goals[SEAL].at(self.times))
        rig = lips.mouth.shapes.rig
        if rig is None:
            return np.asarray(1.0 - (1.0 - value * (1.0 - tuck)) * (1.0 - lips.goals[SEAL].at(self.times)))
        own, seal = self.sealed(lips, rig)
        # What other channels seal besides.
        kept = np.divide(1.0 - value, 1.0 - own, out=np.ones(len(own)), where=own < value)
        return (1.0 - (1.0 - seal) * kept) * beside_tuck(tuck)

    def sealed(self, lips: CompiledLips, rig: LipRig) -> tuple[Array, Array]:
        """Return the seal that the segments ask for, and with what brings the gap to it, shape (n,) both."""
        own = lips.at(SEAL, self.times) if SEAL in lips.parameters else np.zeros(len(self.times))
        return own, lips.mouth.approach.sealed(own, self.times, self._parted(lips.mouth, rig))

    def _parted(self, mouth: SpeechMouth, rig: LipRig) -> Parted | None:
        """Return how lips and others part the mouth; None where the others do not."""
        if not self._others_open():
            return None
        alone = rig.gap({n: self.own(n) for n in OPENING})
        return Parted(alone, rig.gap({n: self.value(n) for n in OPENING}), mouth.speaking_at(self.times))

    def _others_open(self) -> bool:
        """Return whether another channel than speech moves what parts the lips."""
        channels = (channel for channel in self.plan.channels if channel.name != LIPS)
        return any(not OPENING.isdisjoint(channel.curves) for channel in channels)

    def terms(self, name: str) -> list[tuple[tuple[Channel, Curve], Array]]:
        """Return the deviation that each layer of each channel asks of a direction, shape (n,) each."""
        found = []
        for channel in self.plan.channels:
            for curve in channel.curves.get(name, ()):
                dense = np.zeros(len(self.times))
                index, values = curve.sample(self.times)
                dense[index] = values
                found.append(((channel, curve), dense))
        return found


def at(score: Score, times: Array, rig: LipRig | None = None) -> Array:
    """Return all parameters of a score at any times, seconds: shape (n,) -> (n, 46), in the table's order.

    Raises InputError or ParameterError if the score cannot be performed.
    """
    return Plan(score, rig).at(times)


def combine(score: Score, fps: Fraction, rig: LipRig | None = None) -> Performance:
    """Return the performance of a score at frames k/fps, k = 0 … round(duration·fps).

    Two stages (paper A, sections 5 and 6; DESIGN, section 3): within each channel, then across channels by
    the policy that the score's settings name. Values do not depend on `fps`. `rig`: the head's, which a
    score needs whose lips are articulators. Raises InputError or ParameterError if the score cannot be
    performed.
    """
    return Plan(score, rig).performance(fps)
