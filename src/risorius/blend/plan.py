"""From a score to curves: the page on which all parts of the combination meet.

The movements of a layer are concatenated and the lip segments blended; a ledger per parameter resolves the
conflicts between channels and applies the limits of speech; then the channels are joined, what comes out is
rounded, and the contact goals come last.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np

from ..core.arrays import Array
from ..core.channels import CHANNELS
from ..core.lips.lip_rig import OPENING, LipRig
from ..core.parameters import INDEX, NAMES, NEUTRAL, PARAMETERS, Kind
from ..core.performance import Performance, frame_times
from ..core.score import Score, check_score
from . import mouth, policies  # noqa: F401 - models and policies register themselves
from .action_unit_sums import ActionUnitSums
from .channels import compile_channels
from .concatenate import SIGNED
from .conflict import POLICIES, Join, PolicyInputs
from .directions import combine_directions
from .knots import BLOCK, smoothstep
from .layers import CompiledLayers
from .ledger import DirectionEntry, Ledger, direction_entries
from .mouth.closure_speed import MouthGaps, smooth_maximum, smooth_minimum
from .mouth.coarticulation import LIP_MODELS
from .mouth.contact import CONTACTS
from .mouth.limits import LIPS, SpeechLimits
from .mouth.lips import CompiledLips
from .mouth.sealing import apply_contact_goals
from .mouth.speech_mouth import JAW
from .priority_curve import steady
from .rounding import MORE, SAMPLES, SHARP, Rounding, SmoothingWindow
from .sides import twins_of
from .tuning import tune

TAKEN_OVER = 0.06
"""Share of a muscle's range over which the transition between speech and a display is rounded."""
JAW_ROUNDED = 0.06
"""Share of the jaw's range over which it is rounded before the limit of a closed mouth."""
CHUNK = 16_384
"""Times computed at once: memory beyond the result does not grow with its length."""


class Plan:
    """A compiled score: its curves at any times, on the head whose `rig` performs the lips' articulators.

    `like` is the plan of a score with other movements: if lips and settings are equal, its compiled lips are
    used again, and so are layers whose movements are the same. Raises as `check_score` and `tune` do, and
    InputError if the lips need a rig and `rig` is None.
    """

    score: Score
    layers: CompiledLayers

    def __init__(self, score: Score, rig: LipRig | None = None, like: Plan | None = None) -> None:
        check_score(score, like.score if like else None)
        policy = POLICIES.get(score.settings.conflict)
        LIP_MODELS.get(score.settings.lips)
        self.score, self.rig = score, rig
        self.tuning = tune(score.settings)
        self.rounding = Rounding(score)
        self.lips: CompiledLips | None
        if like is not None and like.rig is rig and _speak_alike(like.score, score):
            self.lips = like.lips
        else:
            self.lips = CompiledLips(score, self.tuning, rig) if score.lips else None
        self.layers = CompiledLayers(score, like.layers if like else None)
        self.channels = compile_channels(score, self.lips, self.layers)
        levels = next(
            (c.levels for c in self.channels if c.name == LIPS), steady(CHANNELS.get(LIPS).priority)
        )
        self.limits = SpeechLimits(self.lips.mouth, levels) if self.lips else None
        self.inputs = PolicyInputs(self.channels, self.tuning, self.limits)
        self.policy = policy(self.inputs)
        self.units = ActionUnitSums(score) if self.policy.join is Join.ADD else None
        limited = self.lips.mouth.limited if self.lips else frozenset()
        contacts = CONTACTS if self.lips else ()
        self.twins = twins_of(self.channels, self.lips)
        self.moving = sorted({*(n for c in self.channels for n in c.curves), *limited, *contacts})

    def at(self, times: Array, names: Container[str] = NAMES) -> Array:
        """Return all parameters at the times, seconds, in any order, shape (n,) -> (n, 46).

        Those that are not in `names` stay at rest.
        """
        times = np.asarray(times, dtype=np.float64)
        order = np.argsort(times, kind="stable")
        values = np.empty((len(times), len(NAMES)))
        for chunk in _chunks(times[order]):
            values[order[chunk]] = PlanSample(self, times[order[chunk]]).values(names)
        return values

    def performance(self, fps: Fraction) -> Performance:
        """Return the performance at frames k/fps, k = 0 … round(duration·fps)."""
        return Performance(self.score, fps, self.at(frame_times(self.score.duration, fps)))

    def performance_like(self, other: Performance, span: tuple[float, float]) -> Performance:
        """Return the performance at the frames of another that is equal outside `span`, seconds."""
        times, values = other.times, other.values.copy()
        here = slice(*np.searchsorted(times, span).tolist())
        if here.start < here.stop:
            values[here] = self.at(times[here])
        return Performance(self.score, other.fps, values)

    @property
    def sums(self) -> bool:
        """Whether the policy adds up the channels."""
        return self.policy.join is not Join.MAX

    def adds(self, name: str) -> bool:
        """Return whether channels add up in a parameter; else the highest wins."""
        return self.sums or name in SIGNED or (name == JAW and self.lips is not None)

    def batches(self, times: Array) -> Iterator[Array]:
        """Yield sorted times in batches that lie in one block and are not too long."""
        for chosen in _chunks(times):
            yield times[chosen]


def _speak_alike(a: Score, b: Score) -> bool:
    """Return whether the lips of two scores are equal, and so are the settings that shape them."""
    chosen = (replace(s.settings, conflict="", onset_function=None) for s in (a, b))
    return len(set(chosen)) == 1 and (a.lips is b.lips or a.lips == b.lips)


def _chunks(times: Array) -> Iterator[slice]:
    edges = np.flatnonzero(np.diff(np.floor(times / BLOCK))) + 1
    for first, last in pairwise((0, *edges.tolist(), len(times))):
        for start in range(first, last, CHUNK):
            yield slice(start, min(start + CHUNK, last))


class PlanSample:
    """A plan at some sorted times of one block, shape (n,), at least one."""

    def __init__(self, plan: Plan, times: Array) -> None:
        self.plan, self.times = plan, times
        self._resolve = plan.policy.at(times)
        self._ledgers: dict[str, Ledger] = {}
        self._turns: dict[Kind, dict[str, list[DirectionEntry]]] = {}
        self._joined: dict[str, Array] = {}
        self._values: dict[str, Array] = {}
        self._around: dict[tuple[float, bool], tuple[SmoothingWindow, PlanSample]] = {}

    def values(self, names: Container[str] = NAMES) -> Array:
        """Return all parameters, shape (n, 46); those that are not in `names` stay at rest."""
        values = np.tile(NEUTRAL, (len(self.times), 1))
        for name in self.plan.moving:
            if name in names:
                values[:, INDEX[name]] = self.value(name)
        return values

    def joined(self, name: str) -> Array:
        """Return a parameter by all channels together, before the last steps, shape (n,)."""
        if name not in self._joined:
            self._joined[name] = self._direction(name) if name in SIGNED else self._together(name)
        return self._joined[name]

    def value(self, name: str) -> Array:
        """Return one parameter after all steps, shape (n,)."""
        twin = self.plan.twins.get(name)
        if twin is not None:
            return self.value(twin)
        if name not in self._values:
            total, lips = self.rounded(name), self.plan.lips
            if lips is not None and name in CONTACTS:
                speech = self.rounded(name, PlanSample.speech)
                total = apply_contact_goals(name, total, speech, self.times, lips, self.mouth_gaps)
            self._values[name] = total
        return self._values[name]

    def rounded(self, name: str, read: Callable[[PlanSample, str], Array] = joined) -> Array:
        """Return the values of `read` for a parameter, averaged around each time, shape (n,)."""
        width = self.plan.rounding.width(name)
        if not width:
            return read(self, name)
        even = self.plan.rounding.even(name)
        if (width, even) not in self._around:
            surroundings = self._window(name, self.times)
            self._around[width, even] = surroundings, PlanSample(self.plan, surroundings.times)
        surroundings, sample = self._around[width, even]
        around = read(sample, name)
        average = surroundings.average(around)
        if not even:
            self._average_corners(name, read, average, surroundings.sharpness(around))
        exact = self.plan.rounding.exact(name, self.times)
        return np.where(exact, read(self, name), average) if exact.any() else average

    def _window(self, name: str, times: Array, samples: int = SAMPLES) -> SmoothingWindow:
        rounding, end = self.plan.rounding, self.plan.score.duration
        return SmoothingWindow(times, rounding.width(name), end, even=rounding.even(name), samples=samples)

    def _average_corners(
        self, name: str, read: Callable[[PlanSample, str], Array], average: Array, sharpness: Array
    ) -> None:
        """Compute averages (n,) of a parameter anew if its curve is sharp there, from more times around."""
        shares = smoothstep(np.clip(sharpness / SHARP - 1.0, 0.0, 1.0))
        here = np.flatnonzero(shares)
        if len(here):
            around = self._window(name, self.times[here], MORE)
            closer = around.average(read(PlanSample(self.plan, around.times), name))
            average[here] += shares[here] * (closer - average[here])

    def ledger(self, name: str) -> Ledger:
        """Return the ledger of a parameter that is not a direction."""
        if name not in self._ledgers:
            plan = self.plan
            self._ledgers[name] = Ledger(name, self.times, plan.channels, self._resolve, plan.limits)
        return self._ledgers[name]

    def direction_entries(self, name: str) -> list[DirectionEntry]:
        """Return the entries of every curve for a direction."""
        kind = PARAMETERS[INDEX[name]].kind
        if kind not in self._turns:
            self._turns[kind] = direction_entries(kind, self.times, self.plan.channels)
        return self._turns[kind].get(name, [])

    def _direction(self, name: str) -> Array:
        return combine_directions(
            name, [entry.applied for entry in self.direction_entries(name)] or [np.zeros(len(self.times))]
        )

    def _together(self, name: str) -> Array:
        """Return speech and all other channels together, 0..1."""
        ledger, lips = self.ledger(name), self.plan.lips
        others = self._others(ledger)
        if self.plan.adds(name):
            total = ledger.speech + others
        elif self.plan.rounding.width(name) and others.any() and ledger.speech.any():
            total = smooth_maximum(ledger.speech, others, TAKEN_OVER)
        else:
            total = np.maximum(ledger.speech, others)
        total = self._raised(ledger, total)
        if lips is not None and name in lips.mouth.raised:
            total = np.maximum(total, lips.mouth.low_at(name, self.times))
        total = np.minimum(total, 1.0)
        if lips is None or name != JAW:
            return total
        limit = lips.mouth.jaw_at_seal(self.times)
        return np.where(limit < 1.0, smooth_minimum(total, limit, JAW_ROUNDED), total)

    def _others(self, ledger: Ledger) -> Array:
        """Return the joined values of all channels but speech, shape (n,)."""
        by_channel: dict[tuple[str, bool], Array] = {}
        for channel in ledger.channels:
            if channel.name == LIPS or (channel.on_top and self.plan.policy.join is not Join.SUM):
                continue
            entry = ledger.entry(channel)
            values = by_channel.setdefault((channel.name, channel.on_top), np.zeros(len(self.times)))
            values[entry.index] = np.maximum(values[entry.index], entry.applied)
        total = np.zeros(len(self.times))
        for values in by_channel.values():
            total = total + values if self.plan.sums else np.maximum(total, values)
        return self.plan.units.clipped(ledger, total) if self.plan.units else total

    def _raised(self, ledger: Ledger, total: Array) -> Array:
        """Return the values of all channels, and movements on top of them, within the limits of speech."""
        if self.plan.policy.join is Join.SUM:
            return total
        for entry in (ledger.entry(c) for c in ledger.channels if c.on_top):
            here, limits = np.minimum(total[entry.index], 1.0), self.plan.limits
            raised = here + (1.0 - here) * entry.applied
            if limits is not None and limits.bind(entry.channel, ledger.name):
                limit = limits.limit(entry.channel, ledger.name, self.times[entry.index])
                raised = np.minimum(raised, np.maximum(here, limit))
            total = total.copy()
            total[entry.index] = raised
        return total

    def speech(self, name: str) -> Array:
        """Return the lips' own values of a parameter after the policy, shape (n,)."""
        return self.ledger(name).speech

    def mouth_gaps(self, rig: LipRig) -> MouthGaps | None:
        """Return the gap by speech and by all channels; None if only speech can part the lips."""
        channels = (channel for channel in self.plan.channels if channel.name != LIPS)
        if self.plan.lips is None or all(OPENING.isdisjoint(channel.curves) for channel in channels):
            return None
        twins = self.plan.twins
        spoken = {n: self.rounded(n, PlanSample.speech) for n in {twins.get(n, n) for n in OPENING}}
        alone = rig.gap({n: spoken[twins.get(n, n)] for n in OPENING})
        together = rig.gap({n: self.value(n) for n in OPENING})
        return MouthGaps(alone, together, self.plan.lips.mouth.speaking_at(self.times))


def at(score: Score, times: Array, rig: LipRig | None = None) -> Array:
    """Return all parameters of a score at any times, seconds: shape (n,) -> (n, 46), in the table's order.

    Raises InputError or ParameterError if the score cannot be performed.
    """
    return Plan(score, rig).at(times)


def combine(score: Score, fps: Fraction, rig: LipRig | None = None) -> Performance:
    """Return the performance of a score at frames k/fps, k = 0 … round(duration·fps).

    Two stages (paper A, sections 5 and 6; DESIGN, section 3): within each channel, then across channels by
    the policy that the score's settings name. Values do not depend on `fps`. `rig`: the head's; a score with
    articulators as lip targets needs it. Raises InputError or ParameterError if the score cannot be
    performed.
    """
    return Plan(score, rig).performance(fps)
