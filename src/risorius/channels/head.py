"""Head: marks, verbal heads, a speaker's posture, the voice's melody, and a living head's noise.

Paper A, section 2 (noise); paper B, section 2.1 (a final pause is stillness), after Hadar et al. 1983.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Collection, Iterator, Sequence
from itertools import count
from statistics import fmean

from ..core.action_units import resolve_targets
from ..core.channels import POSTURE_LAYER
from ..core.counter_rng import CounterRng
from ..core.movement import Cause, Movement
from ..core.parameters import INDEX, PARAMETERS
from ..core.speech.utterance import PauseKind, Syllable, Utterance
from ..core.time import TICK
from ..rules.match import HEAD
from ..rules.modulation import size_of
from ..rules.rule import TurnState
from .inputs import ChannelInputs, Context
from .registry import register
from .ruled import marked_and_ruled, with_eyes

NOISE, MELODY, POSTURE = "head.noise.idle", "head.melody.pitch", "head.posture.speaker"
# Seconds in which one movement of a chain gives way to the next.
_OVERLAP = 0.02
# Seconds in which the melody goes back when a pause begins, and the head when all is said.
_RELEASE = 0.24
# Seconds that a movement of the noise lasts at least, unless an edge of a pause cuts it.
_SHORTEST = 0.01


def head(inputs: ChannelInputs, context: Context) -> Iterator[Movement]:
    """Yield the marked movements, those of rules, and a smooth wander about the speaker's posture."""
    yield from marked_and_ruled(inputs, context)
    if inputs.lively:
        yield from _posture(inputs)
        yield from _melody(inputs)
        yield from _noise(inputs, context.numbers)


def posture(inputs: ChannelInputs) -> dict[str, float]:
    """Return the postures of profile and attitudes, added up within each parameter's range."""
    total: dict[str, float] = {}
    for targets in (inputs.profile.posture, *(a.posture for a in inputs.attitudes)):
        for name, value in resolve_targets(targets).items():
            p = PARAMETERS[INDEX[name]]
            total[name] = min(max(total.get(name, 0.0) + value, p.low), p.high)
    return total


def _posture(inputs: ChannelInputs) -> Iterator[Movement]:
    targets = {name: value for name, value in posture(inputs).items() if name in HEAD}
    if targets:
        yield Movement(
            "head", 0.0, inputs.duration, 0.0, 0.0, with_eyes(targets),
            id=POSTURE, layer=POSTURE_LAYER, function="minimum_jerk",
            cause=Cause(POSTURE, inputs.profile.name),
        )  # fmt: skip


def _melody(inputs: ChannelInputs) -> Iterator[Movement]:
    """Yield a chain in which the head rises and falls with the voice's pitch.

    It follows each accented syllable quickly, between accents the mean of the others slowly (paper B, section
    5.2: rapid movements occur on accents), and goes back where a pause begins. Head motion explains some 63 %
    of the variance of F0 (Munhall et al. 2004).
    """
    degrees = inputs.profile.head.melody
    utterance = inputs.utterance
    if utterance is None or degrees == 0.0 or not any(s.pitch for s in utterance.syllables):
        return
    runs = list(_runs(utterance))
    for (run, first), following in zip(
        runs, [*(start for _, start in runs[1:]), inputs.duration], strict=True
    ):
        size = degrees * size_of(MELODY, inputs.modulations_at(first))
        pitch = fmean([min(max(s.pitch, -2.0), 2.0) for s in run])
        cause = Cause(MELODY, f'"{utterance.words[run[0].word].text}"')
        last = run[-1].end
        pauses = following > last + TICK
        end, onset = last if pauses else following, min(last, following) - first
        yield _link(first, end, {"head_pitch": size * pitch}, "melody", cause, onset)
        if pauses:
            seconds = min(following - last, _RELEASE)
            # In a short pause there is time for a part of the way only.
            left = {"head_pitch": (1.0 - seconds / _RELEASE) * size * pitch + 0.0}  # not -0.0
            yield _link(last, following, left, "melody", cause, seconds)


def _runs(said: Utterance) -> Iterator[tuple[list[Syllable], float]]:
    """Yield each accented syllable, and the others from one accent or pause to the next, with their start."""
    accented = {accent.syllable for accent in said.accents}
    run: list[Syllable] = []
    for number, syllable in enumerate(said.syllables):
        if run and (number in accented or number - 1 in accented or syllable.start > run[-1].end + TICK):
            yield run, run[0].start
            run = []
        run.append(syllable)
    if run:
        yield run, run[0].start


def _noise(inputs: ChannelInputs, numbers: CounterRng) -> Iterator[Movement]:
    """Yield a chain of smooth movements to random targets; in pauses they go only a part of the way."""
    habits = inputs.profile.head
    deviations = dict(zip(HEAD, (habits.pitch, habits.yaw, habits.roll), strict=True))
    calm = _Calm(inputs)
    targets = dict.fromkeys(HEAD, 0.0)
    steps = noise_steps(habits.dwell, calm.edges, calm.last, inputs.duration, numbers)
    for number, (start, end, share) in enumerate(steps):
        left, size = calm.at(start), size_of(NOISE, inputs.modulations_at(start))
        for name, sd in deviations.items():
            drawn = numbers.normal(name, number, deviation=size * sd, limit=2.0)
            kept = 0.0 if calm.rests(start) else (1.0 - left * share) * targets[name]
            targets[name] = left * share * drawn + kept
        yield _link(start, end, dict(targets), "noise", Cause(NOISE, "a living head"))


def noise_steps(
    dwell: tuple[float, float],
    edges: Sequence[float],
    last: Collection[float],
    duration: float,
    numbers: CounterRng,
) -> Iterator[tuple[float, float, float]]:
    """Yield start and end in seconds of each movement, and the share 0..1 of its way that there is time for.

    The head sets out for the next target at random, after `dwell` seconds (lowest, highest), and anew at
    `edges`, where pauses begin or end, in order. At `last`, when all is said, it goes home at once.
    """
    low, high = dwell
    start = 0.0
    for number in count():
        if start >= duration:
            return
        dwell_time = numbers.uniform("dwell", number, low=low, high=high)
        if start in last:
            dwell_time = min(dwell_time, _RELEASE)
        next_edges = edges[(index := bisect_right(edges, start)) : index + 1]
        # An edge that comes just after the end is the end: no movement is shorter than `_SHORTEST`.
        end = next((edge for edge in next_edges if edge < start + dwell_time + _SHORTEST), start + dwell_time)
        yield start, end, min((end - start) / dwell_time, 1.0)
        start = end


def _link(
    start: float,
    end: float,
    targets: dict[str, float],
    layer: str,
    cause: Cause,
    onset: float | None = None,
) -> Movement:
    """Return one movement of a chain: unless it has an onset, it is on its way all the time to the next."""
    return Movement(
        "head", start, end + _OVERLAP, end - start if onset is None else onset, _OVERLAP, with_eyes(targets),
        id=f"{cause.rule}@{start:.3f}", layer=layer, function="minimum_jerk", cause=cause,
    )  # fmt: skip


class _Calm:
    """The share of the noise at a time: all in speech, less in pauses and while listening."""

    def __init__(self, inputs: ChannelInputs) -> None:
        habits = inputs.profile.head
        still = {PauseKind.COMMA: habits.comma, PauseKind.HESITATION: habits.comma}
        self._situation, self._listening = inputs.situation, habits.listening
        pauses = inputs.utterance.pauses if inputs.utterance else ()
        words = inputs.utterance.words if inputs.utterance else ()
        speech_end = words[-1].end if words else inputs.duration
        self.last = [p.start for p in pauses if p.start >= speech_end]
        self._spans = [
            (p.start, p.end, habits.final if p.start >= speech_end else still.get(p.kind, habits.final))
            for p in pauses
        ]
        self.edges = sorted({t for start, end, _ in self._spans for t in (start, end)})

    def at(self, time: float) -> float:
        """Return the share 0..1 at a time."""
        if self._situation.turn_at(time) is TurnState.LISTENING:
            return self._listening
        return next((left for start, end, left in self._spans if start <= time < end), 1.0)

    def rests(self, time: float) -> bool:
        """Tell whether nothing more is to be said, so that the head goes back to rest (paper B, 5.2)."""
        return any(start <= time for start in self.last)


register("head", 20.0, head, timing=(0.2, 0.3, "minimum_jerk"), rules=True, marks=True, exclusive=True)
