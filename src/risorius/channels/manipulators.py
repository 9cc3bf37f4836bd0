"""Manipulators: blinks that wet the eyes, random (paper A, channel 1) or periodic (paper B, section 5.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from ..core.movement import Cause, Movement
from ..rules.match import LIDS
from ..rules.profiles import Blinks
from ..rules.synchrony import nearest
from .blinks import blink
from .registry import CHANNEL_BUILDERS, Brief
from .ruled import movements_of_rules

RANDOM, PERIODIC = "manipulators.lids.random", "manipulators.lids.periodic"
# Blinks a second after the wait, and after twice the wait (Itti, Dhavale and Pighin 2003, as hazards).
_HAZARD, _LATE_HAZARD = 1.0, 10.0
# What closes the eyes so far for no longer than this is a blink, seconds.
_SHUT, _LONGEST = 0.5, 0.8
# Seconds between two blinks at least.
_APART = 0.3

Wait = Callable[[float], float]


@CHANNEL_BUILDERS.register("manipulators")
def manipulators(brief: Brief, rng: np.random.Generator) -> Iterator[Movement]:
    """Yield the marked blinks, those of rules, and others where too much time passes without one."""
    known = [*brief.marked("manipulators"), *movements_of_rules(brief, "manipulators")]
    yield from known
    if not brief.lively:
        return
    voluntary = sorted((m for m in (*known, *brief.built) if _is_blink(m)), key=lambda m: m.start)
    habits, boundaries = brief.profile.blinks, brief.units.boundaries
    for start, why in _starts(habits, voluntary, boundaries, brief.duration, rng):
        depth = float(rng.uniform(*habits.depth)) if rng.random() < habits.incomplete else 1.0
        yield blink("manipulators", start, depth, habits, boundaries, Cause(why, "eyes to wet"))


def _is_blink(m: Movement) -> bool:
    return m.targets.get(LIDS[0], 0.0) >= _SHUT and m.end - m.start <= _LONGEST


def _starts(
    habits: Blinks,
    voluntary: Sequence[Movement],
    boundaries: Sequence[float],
    duration: float,
    rng: np.random.Generator,
) -> Iterator[tuple[float, str]]:
    """Yield when blinks are added, between those that happen anyway, and by which rule."""
    if habits.manner == "none":
        return
    length = habits.closing + habits.closed + habits.opening
    last = -float(rng.uniform(0.0, min(habits.wait, habits.period)))
    others = list(voluntary)
    while True:
        start, why = _next(habits, last, boundaries, rng)
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
    habits: Blinks, last: float, boundaries: Sequence[float], rng: np.random.Generator
) -> tuple[float, str]:
    """Return when the next blink comes after the one that ended at `last`."""
    random = last + blink_interval(rng, habits.wait), RANDOM
    periodic = max(nearest(last + habits.period, boundaries), last + _APART), PERIODIC
    if habits.manner == "both":
        return min(random, periodic)
    return periodic if habits.manner == "periodic" else random


def blink_interval(rng: np.random.Generator, wait: float) -> float:
    """Return a random time in seconds from the end of a blink to the start of the next, 1 to 3 waits."""
    budget = rng.exponential()
    early = _HAZARD * wait
    if budget < early:
        return wait + budget / _HAZARD
    return min(2.0 * wait + (budget - early) / _LATE_HAZARD, 3.0 * wait)
