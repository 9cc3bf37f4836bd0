"""Gaze: where the eyes go, and how eyes and head share the way.

Looks come from the script, from rules (regulators, pointing) and from the habit of looking away now and then;
between them the eyes scan the listener's face (paper B, section 5.2). Every shift is a saccade on the main
sequence; the head follows a large one by Freedman's law while the eyes counter-rotate.

Nothing is decided by what will be said later: whether a sentence ends the turn shows half a second before its
end (`HORIZON`). Until then it counts as if it might: what its look at the listener would break up at once is
not begun.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import count

from ..core.counter_rng import CounterRng
from ..core.movement import Cause, Movement
from ..core.time import TICK
from ..rules.emotions import emotion_key
from ..rules.markup import markup_table
from ..rules.match import EYES, Event
from ..rules.modulation import rate_of
from ..rules.profiles import Aversion
from ..rules.rule import AWAY, Level, RuleAnchor, TurnState
from ..rules.synchrony import MovementPhases
from .blinks import blink
from .eye_head import BLINK, Angles, GazeShift, blinks_with, head_help, shifts_of
from .inputs import ChannelInputs, Context
from .registry import register
from .ruled import movements_of_rules

HAPPY = "happiness"
# Happiness of this intensity is seen as a smile.
_SMILING = 0.2
AVERSION, SCAN, REST = "gaze.aversion.habit", "gaze.scan.face", "gaze.rest.listener"
LISTENER: Angles = (0.0, 0.0)
# A look shorter than this is not begun, seconds.
_SHORTEST = 0.3
# Seconds from the start of one saccade to the next at least (50 to 100 ms between two: Lee et al. 2002).
_REFRACTORY = 0.15
# An aversion is not begun if a sentence, and perhaps the turn, ends within this time, seconds.
_FORESIGHT = 1.0
# Seconds after a sentence may have been seen to end in which a shift of gaze brings no blink: the pause does.
_BLINKLESS = 0.7
# A factor on how often something happens that makes it happen no more in any clip.
_NEVER = 1e-9
# How far a look up or down strays sideways, and one aside up or down: degrees.
_STRAY = 2.5


@dataclass(frozen=True, slots=True)
class Glance:
    """A direction held over [start, end) seconds; `fixed`: the script's, which the eyes do not scan."""

    start: float
    end: float
    direction: Angles
    cause: Cause
    fixed: bool = False


def gaze(inputs: ChannelInputs, context: Context) -> Iterator[Movement]:
    """Yield the marked gaze with the head's share of it, and the fixations of the clip, one after another."""
    marked = inputs.marked("gaze")
    yield from marked
    yield from (helped for m in marked if (helped := head_help(m)) is not None)
    yield from movements_of_rules(inputs, context)
    if not inputs.lively:
        return
    # Listening marks only the gaze target; random gaze shifts stay enabled.
    looking = [m for m in marked if (m.start, m.end) not in inputs.listening]
    yield from _blinks(looking, inputs, context.numbers)
    looks = [Glance(m.start, m.end, LISTENER, m.cause, fixed=True) for m in looking]
    numbers, ends = context.numbers, _Ends(inputs)
    looks = _averted(inputs, _commanded(inputs, _apart(looks), ends, context), ends, numbers)
    shifts = list(_fixations(inputs, looks, ends, numbers))
    units, habits = inputs.units, inputs.profile
    pauses = [pause for pause in units.pauses if pause.start > 0.0]  # before all words the head is free
    yield from shifts_of(
        shifts, inputs.duration, habits.blinks, units.boundaries, pauses, numbers, habits.gaze.zone
    )


class _Ends:
    """The times at which looks that end a turn may begin: a turn may end with each of its sentences."""

    def __init__(self, inputs: ChannelInputs) -> None:
        ending = (r for r in inputs.rules if r.level is Level.TURN and r.timing.at is RuleAnchor.END)
        lead = max((r.timing.lead for r in ending if r.effect.look is not None), default=0.0)
        sentences = inputs.utterance.sentences if inputs.utterance is not None else ()
        self._times = [sentence.end - lead for sentence in sentences]

    def within(self, start: float, end: float) -> bool:
        """Tell whether such a look may begin in [start, end) seconds."""
        return bisect_left(self._times, start) < bisect_left(self._times, end)


def _blinks(looking: Sequence[Movement], inputs: ChannelInputs, numbers: CounterRng) -> Iterator[Movement]:
    """Yield the blinks with marked looks, as with all others."""
    habits, boundaries = inputs.profile.blinks, inputs.units.boundaries
    for number, mark in enumerate(looking):
        degrees = math.hypot(*(mark.targets.get(eye, 0.0) for eye in EYES))
        if blinks_with(degrees, habits, numbers.under("marked", number)):
            cause = Cause(BLINK, mark.label)
            yield blink("gaze", mark.start, 1.0, habits, boundaries, cause, f"lids.{number}")


def _smiles(inputs: ChannelInputs) -> list[Glance]:
    """Return the spans in which the speaker feels happy, as looks at the listener."""
    shown = [d for d in inputs.situation.felt if emotion_key(d.emotion) == HAPPY and d.intensity >= _SMILING]
    spans = [(d.start or 0.0, inputs.duration if d.end is None else d.end) for d in shown]
    return [Glance(start, end, LISTENER, Cause(REST, "a smile")) for start, end in spans]


def _silence(inputs: ChannelInputs) -> list[Glance]:
    """Return the time after the last word, up to the next listening, as a look at the listener."""
    if inputs.utterance is None or not inputs.utterance.words:
        return []
    start = inputs.utterance.words[-1].end
    end = min([inputs.duration, *(first for first, last in inputs.listening if last > start)])
    return [Glance(start, end, LISTENER, Cause(REST, "all is said"))] if end > start else []


def _apart(looks: Sequence[Glance]) -> list[Glance]:
    """Return looks in order, each ended where the next begins."""
    ordered = sorted(looks, key=lambda k: k.start)
    ends = [*(k.start for k in ordered[1:]), math.inf][: len(ordered)]
    return [replace(k, end=min(k.end, end)) for k, end in zip(ordered, ends, strict=True) if k.start < end]


def _commanded(
    inputs: ChannelInputs, marked: Sequence[Glance], ends: _Ends, context: Context
) -> list[Glance]:
    """Return the marked looks, and those of rules if they do not stand against them, one after another."""
    looks = list(marked)
    events = [e for e in context.events if e.rule.effect.look is not None]
    smiles = _smiles(inputs)
    for event in sorted(events, key=lambda e: (e.rule.channel != "gaze", -e.span.start, e.rule.id)):
        start, direction = event.span.start, _aimed(event, inputs, context.numbers)
        if event.rule.effect.look == AWAY and any(_meets(event.span, smile) for smile in smiles):
            continue
        if direction != LISTENER and ends.within(start, start + _SHORTEST):
            continue
        end = min([event.span.end, *(k.start for k in looks if k.end > start)])
        if end - start >= (TICK if direction == LISTENER else _SHORTEST):
            looks.append(Glance(start, end, direction, Cause(event.rule.id, event.unit.text)))
    return sorted(looks, key=lambda k: k.start)


def _meets(span: MovementPhases, look: Glance) -> bool:
    return span.start < look.end and look.start < span.end


def _aimed(event: Event, inputs: ChannelInputs, numbers: CounterRng) -> Angles:
    name = str(event.rule.effect.look)
    if name == AWAY:
        return _away(inputs, numbers.under(event.rule.id, event.unit.phrase, event.unit.number))
    direction = markup_table().gaze[name]
    scale = event.rule.effect.size
    return scale * direction.pitch, scale * direction.yaw


def _away(inputs: ChannelInputs, numbers: CounterRng) -> Angles:
    """Return a random direction away from the listener."""
    habits = inputs.profile.gaze
    way = numbers.choice(habits.directions, "way")
    stray = numbers.normal("stray", deviation=_STRAY)
    if way == "side":
        sign = 1.0 if numbers.uniform("side") < 0.5 * (1.0 + inputs.profile.side) else -1.0
        return stray, sign * _around(habits.yaw, numbers, "angle")
    return (1.0 if way == "up" else -1.0) * _around(habits.pitch, numbers, "angle"), 2.0 * stray


def _around(normal: tuple[float, float], numbers: CounterRng, what: str) -> float:
    mean, deviation = normal
    return numbers.normal(what, mean=mean, deviation=deviation, limit=2.0)


def _averted(
    inputs: ChannelInputs, looks: Sequence[Glance], ends: _Ends, numbers: CounterRng
) -> list[Glance]:
    """Return the looks, and among them those away that regulate intimacy (Andrist et al. 2013).

    None begins during a smile, after the last word or near the end of a sentence. Other looks cut them short.
    """
    glances = list(looks)
    looks = sorted([*looks, *_smiles(inputs), *_silence(inputs)], key=lambda k: k.start)
    time = numbers.uniform("first aversion") * _aversion(inputs, 0.0).gap[0] / _often(inputs, 0.0)
    for number in count():
        if time >= inputs.duration:
            break
        own = numbers.under("aversion", number)
        habit = _aversion(inputs, time)
        end = time + _around(habit.length, own, "length")
        direction = _away(inputs, own)
        foreseen = time + _SHORTEST
        rival = next((k for k in looks if k.start < foreseen and time < k.end + _SHORTEST), None)
        end = min([end, *(k.start for k in looks if k.start >= foreseen)])
        if rival is None and ends.within(time, time + _FORESIGHT):
            time += _FORESIGHT + _SHORTEST
            continue
        if rival is None and end < inputs.duration:
            glances.append(Glance(time, end, direction, Cause(AVERSION, "habit")))
        last = end if rival is None else rival.end
        if rival is not None and rival.direction == LISTENER:
            time = last + _SHORTEST
            continue
        time = last + max(_around(habit.gap, own, "gap"), _SHORTEST) / _often(inputs, last)
    return sorted(glances, key=lambda k: k.start)


def _often(inputs: ChannelInputs, time: float) -> float:
    """Return the factor on how often the speaker looks away at a time; as good as never is above 0."""
    return max(rate_of(AVERSION, inputs.modulations_at(time)), _NEVER)


def _aversion(inputs: ChannelInputs, time: float) -> Aversion:
    speaking = inputs.situation.turn_at(time) is TurnState.SPEAKING and inputs.utterance is not None
    return inputs.profile.gaze.speaking if speaking else inputs.profile.gaze.listening


def _fixations(
    inputs: ChannelInputs, looks: Sequence[Glance], ends: _Ends, numbers: CounterRng
) -> Iterator[GazeShift]:
    """Yield the shifts of gaze in order: to each look, back, and about the target meanwhile."""
    time = 0.0

    def shift(start: float, direction: Angles, cause: Cause) -> GazeShift:
        return GazeShift(start, direction, cause, not ends.within(start - _BLINKLESS, start + TICK))

    for number, look in enumerate(looks):
        before = numbers.under("scan before", number)
        yield from _scan(inputs, time, look.start, LISTENER, ends, before)
        yield shift(look.start, look.direction, look.cause)
        if not look.fixed:
            meanwhile = numbers.under("scan", number)
            yield from _scan(inputs, look.start, look.end, look.direction, ends, meanwhile)
        time = look.end
        if time < inputs.duration:
            yield shift(time, LISTENER, Cause(REST, "the listener"))
    after = numbers.under("scan before", len(looks))
    yield from _scan(inputs, time, inputs.duration, LISTENER, ends, after)


def _scan(
    inputs: ChannelInputs, start: float, end: float, centre: Angles, ends: _Ends, numbers: CounterRng
) -> Iterator[GazeShift]:
    """Yield saccades about a direction, at random times in (start, end); so small, they bring no blink."""
    habits = inputs.profile.gaze
    time = start
    for number in count():
        time += _fixation(habits.scan, numbers.under("fixation", number))
        if time + _REFRACTORY >= end:
            return
        if ends.within(time, time + _REFRACTORY):
            continue
        point = (
            numbers.normal("pitch", number, mean=centre[0], deviation=habits.scan_pitch, limit=2.0),
            numbers.normal("yaw", number, mean=centre[1], deviation=habits.scan_yaw, limit=2.0),
        )
        cause = Cause(SCAN, "the listener's face" if centre == LISTENER else "looking")
        yield GazeShift(time, point, cause, blinks=False)


def _fixation(mean: float, numbers: CounterRng) -> float:
    """Return seconds of a fixation: none shorter than the eyes' refractory time, few much longer.

    The rest of the time follows a gamma distribution of shape 2, the sum of two exponential ones.
    """
    beyond = numbers.exponential("first") + numbers.exponential("second")
    return _REFRACTORY + 0.5 * max(mean - _REFRACTORY, 0.05) * beyond


# The eyes' angle sets onset and offset (`saccade_duration`); these hold for the distance at which they look.
register("gaze", 20.0, gaze, timing=(0.2, 0.2, "saccade"), rules=True, marks=True, exclusive=True)
