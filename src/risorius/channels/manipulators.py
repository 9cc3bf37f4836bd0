"""Manipulators: blinks that wet the eyes, random (paper A, channel 1) or periodic (paper B, section 5.2)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count

from ..core.counted import Counted
from ..core.movement import Cause, Movement
from ..rules.match import LIDS
from ..rules.profiles import BlinkHabits
from ..rules.synchrony import nearest
from .blinks import blink
from .inputs import ChannelInputs, Context
from .registry import register
from .ruled import marked_and_ruled

RANDOM, PERIODIC = "manipulators.lids.random", "manipulators.lids.periodic"
# Blinks a second after the wait, and after twice the wait (Itti, Dhavale and Pighin 2003, as hazards).
_HAZARD, _LATE_HAZARD = 1.0, 10.0
# What closes the eyes so far for no longer than this is a blink, seconds.
_SHUT, _LONGEST = 0.5, 0.8
# Seconds between two blinks at least.
_APART = 0.3


def manipulators(inputs: ChannelInputs, context: Context) -> Iterator[Movement]:
    """Yield the marked blinks, those of rules, and others where too much time passes without one."""
    known = list(marked_and_ruled(inputs, context))
    yield from known
    if not inputs.lively:
        return
    voluntary = sorted((m for m in (*known, *context.built) if _is_blink(m)), key=lambda m: m.start)
    habits, boundaries = inputs.profile.blinks, inputs.units.boundaries
    starts = _starts(habits, voluntary, boundaries, inputs.duration, context.numbers)
    for number, (start, why) in enumerate(starts):
        depth = _depth(habits, context.numbers.under("depth", number))
        yield blink("manipulators", start, depth, habits, boundaries, Cause(why, "eyes to wet"))


def _depth(habits: BlinkHabits, numbers: Counted) -> float:
    """Return how far a blink closes the eyes, 0..1."""
    if numbers.uniform("incomplete") >= habits.incomplete:
        return 1.0
    low, high = habits.depth
    return numbers.uniform("depth", low=low, high=high)


def _is_blink(m: Movement) -> bool:
    return m.targets.get(LIDS[0], 0.0) >= _SHUT and m.end - m.start <= _LONGEST


def _starts(
    habits: BlinkHabits,
    voluntary: Sequence[Movement],
    boundaries: Sequence[float],
    duration: float,
    numbers: Counted,
) -> Iterator[tuple[float, str]]:
    """Yield when blinks are added, between those that happen anyway, and by which rule."""
    if habits.manner == "none":
        return
    length = habits.closing + habits.closed + habits.opening
    last = -numbers.uniform("first", high=min(habits.wait, habits.period))
    others = list(voluntary)
    for number in count():
        start, why = _next(habits, last, boundaries, numbers.under("interval", number))
        while others and others[0].start < last:
            others.pop(0)
        if others and others[0].start < start + length + _APART:
            last = others.pop(0).end
            continue
        if start + length >= duration:
            return
        yield start, why
        last = start + length


def _next(
    habits: BlinkHabits, last: float, boundaries: Sequence[float], numbers: Counted
) -> tuple[float, str]:
    """Return when the next blink comes after the one that ended at `last`."""
    random = last + blink_interval(numbers, habits.wait), RANDOM
    periodic = max(nearest(last + habits.period, boundaries), last + _APART), PERIODIC
    if habits.manner == "both":
        return min(random, periodic)
    return periodic if habits.manner == "periodic" else random


def blink_interval(numbers: Counted, wait: float) -> float:
    """Return a random time in seconds from the end of a blink to the start of the next, 1 to 3 waits."""
    budget = numbers.exponential()
    early = _HAZARD * wait
    if budget < early:
        return wait + budget / _HAZARD
    return min(2.0 * wait + (budget - early) / _LATE_HAZARD, 3.0 * wait)


# A blink's timing: paper B, section 5 (1/8 s of closure, 1/24 s closed, 1/12 s of aperture). Built last: no
# blink is added where another channel has one.
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
