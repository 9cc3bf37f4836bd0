"""Manipulators: blinks that wet the eyes (paper A, channel 1; paper B, section 5.2), by one of three models.

In every model, blinks that rules, shifts of gaze and the script ask for count as the last ones.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import count

from ..core.counter_rng import CounterRng
from ..core.movement import Cause, Movement
from ..rules.match import EYES, LIDS
from ..rules.profiles import BlinkHabits
from .blinks import blink, blink_depth, blink_seconds
from .inputs import ChannelInputs, Context
from .registry import register
from .ruled import marked_and_ruled

NATURAL, ITTI, PELACHAUD = (f"manipulators.lids.{name}" for name in ("natural", "itti", "pelachaud"))
# Blinks a second after one, two and three waits (facts: science/03, section 3.1, for its step of 0.1 ms).
_HAZARDS = (1.0, 10.0, 1000.0)
# A movement that closes the eyes at least this far (0..1) and lasts at most this long (seconds) is a blink.
_SHUT, _LONGEST = 0.5, 0.8
# Degrees beyond which a saccade shifts attention; those about a face are smaller (profiles: `scan_pitch`,
# `scan_yaw`), and would let no eye wait long enough for a blink.
_ATTENTION = 5.0
# Seconds between two blinks at least.
_APART = 0.25

NextBlink = Callable[[float, CounterRng], float]
"""(end of what the wait runs from, numbers) -> when the next blink comes, seconds."""
WaitReset = tuple[float, float, float]
"""Start and end of an event that restarts the wait for a blink, and the seconds before it without blinks."""


def manipulators(inputs: ChannelInputs, context: Context) -> Iterator[Movement]:
    """Yield the marked blinks, those of rules, and others if too much time passes without one."""
    known = list(marked_and_ruled(inputs, context))
    yield from known
    habits, boundaries = inputs.profile.blinks, inputs.units.boundaries
    if not inputs.lively or habits.model == "none":
        return
    rule, following = _model(habits)

    def added(start: float, number: int) -> Movement:
        depth = blink_depth(habits, context.numbers.under("depth", number))
        return blink("manipulators", start, depth, habits, boundaries, Cause(rule, "eyes to wet"))

    length = blink_seconds(habits)
    events = _events([*known, *context.built], length, saccades=habits.model == "itti")
    yield from _between(events, inputs.duration - length, following, added, context.numbers)


def _events(others: Sequence[Movement], length: float, *, saccades: bool) -> list[WaitReset]:
    """Return the blinks among other movements, and if wanted the saccades, in order."""
    found = [(m.start, m.end, length + _APART) for m in others if _is_blink(m)]
    if saccades:
        found += [(m.start, m.start + m.onset, 0.0) for m in _attention_shifts(others)]
    return sorted(found)


def _is_blink(m: Movement) -> bool:
    return m.parameters.get(LIDS[0], 0.0) >= _SHUT and m.end - m.start <= _LONGEST


def _attention_shifts(others: Sequence[Movement]) -> Iterator[Movement]:
    """Yield the saccades that shift attention; those that scan a face go less far."""
    before: dict[str, Mapping[str, float]] = {}
    for m in sorted(others, key=lambda m: m.start):
        if m.channel != "gaze" or not any(eye in m.targets for eye in EYES):
            continue
        last = before.get(m.layer, {})
        before[m.layer] = m.targets
        way = math.hypot(*(m.targets.get(eye, 0.0) - last.get(eye, 0.0) for eye in EYES))
        if m.function == "saccade" and way > _ATTENTION:
            yield m


def _model(habits: BlinkHabits) -> tuple[str, NextBlink]:
    """Return the rule by which blinks come, and when the next one does."""
    if habits.model == "itti":
        return ITTI, lambda last, numbers: last + itti_wait(numbers, habits.wait)
    if habits.model == "pelachaud":
        return PELACHAUD, lambda last, _: last + habits.period
    return NATURAL, lambda last, numbers: last + natural_interval(numbers, *habits.interval)


def _between(
    events: list[WaitReset],
    latest: float,
    following: NextBlink,
    added: Callable[[float, int], Movement],
    numbers: CounterRng,
) -> Iterator[Movement]:
    """Yield the blinks that are added between events, the last one at the `latest` time, seconds.

    The first comes after a part of its wait: the eyes have blinked before the clip.
    """
    last = 0.0
    for number in count():
        own = numbers.under("interval", number)
        start = following(last, own)
        if number == 0:
            start *= own.uniform("elapsed")
        if events and events[0][0] < start + events[0][2]:
            last = events.pop(0)[1]
        elif start >= latest:
            return
        else:
            movement = added(start, number)
            yield movement
            last = movement.end
        while events and events[0][0] < last:
            last = max(last, events.pop(0)[1])


def natural_interval(numbers: CounterRng, median: float, deviation: float) -> float:
    """Return a log-normal time in seconds; `deviation`: the standard deviation of its logarithm."""
    return median * math.exp(numbers.normal("normal", deviation=deviation))


def itti_wait(numbers: CounterRng, wait: float) -> float:
    """Return a random time in seconds from a saccade or blink to the next blink.

    None comes before the typical wait; then they come at random, ever more often after two and three waits.
    """
    budget, passed = numbers.exponential(), wait
    for hazard in _HAZARDS[:-1]:
        if budget < hazard * wait:
            return passed + budget / hazard
        budget, passed = budget - hazard * wait, passed + wait
    return passed + budget / _HAZARDS[-1]


# A blink's timing: paper B, section 5 (1/8 s of closure, 1/24 s closed, 1/12 s of aperture). Built last: no
# blink is added if another channel has one.
register(
    "manipulators",
    50.0,
    manipulators,
    timing=(0.125, 0.0833, "minimum_jerk"),
    rules=True,
    marks=True,
    exclusive=True,
    order=1,
)
