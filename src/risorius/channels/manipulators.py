"""Manipulators: random blinks that wet the eyes (paper A, channel 1)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..core.movement import Cause, Movement
from ..core.parameters import parameters_named
from .registry import CHANNEL_BUILDERS, Brief

# Blinking after Itti's group: no blink within WAIT seconds of the last, then one per second, ten per second
# after 2 WAIT, at the latest at 3 WAIT (facts: science/03, section 3.1; as hazards, free of the step).
WAIT = 1.8
_HAZARD, _LATE_HAZARD = 1.0, 10.0

# Closing 75-90 ms, closed 10-50 ms, opening asymptotic 100-240 ms (facts: science/03, section 3.6).
CLOSING, CLOSED, OPENING = 0.085, 0.045, 0.17
# Spontaneous blinks are often incomplete (facts: science/03, section 3.5): this share of them, this far.
_INCOMPLETE = 0.3
_INCOMPLETE_RANGE = (0.75, 0.95)
_LIDS = tuple(p.name for p in parameters_named("orbicularis_oculi_palpebralis"))


@CHANNEL_BUILDERS.register("manipulators")
def manipulators(brief: Brief, rng: np.random.Generator) -> Iterator[Movement]:
    """Yield the marked blinks and random ones that keep clear of them."""
    marked = sorted((m for m in brief.marks if m.channel == "manipulators"), key=lambda m: m.start)
    yield from marked
    if brief.lively:
        last = -rng.uniform(0.0, 1.5 * WAIT)
        while (start := last + blink_interval(rng)) + CLOSING + CLOSED + OPENING < brief.duration:
            overlapping = _end_of_overlapping(marked, start)
            if overlapping is None:
                yield _blink(start, rng)
            last = overlapping or start + CLOSING + CLOSED + OPENING


def blink_interval(rng: np.random.Generator) -> float:
    """Return a random time in seconds from the end of a blink to the start of the next, WAIT to 3 WAIT."""
    budget = rng.exponential()
    early = _HAZARD * WAIT
    if budget < early:
        return WAIT + budget / _HAZARD
    return min(2.0 * WAIT + (budget - early) / _LATE_HAZARD, 3.0 * WAIT)


def _end_of_overlapping(marked: list[Movement], start: float) -> float | None:
    end = start + CLOSING + CLOSED + OPENING
    return next((m.end for m in marked if m.start < end and start < m.end), None)


def _blink(start: float, rng: np.random.Generator) -> Movement:
    depth = rng.uniform(*_INCOMPLETE_RANGE) if rng.random() < _INCOMPLETE else 1.0
    return Movement(
        "manipulators",
        start,
        start + CLOSING + CLOSED + OPENING,
        CLOSING,
        OPENING,
        dict.fromkeys(_LIDS, float(depth)),
        id=f"blink@{start:.3f}",
        function="minimum_jerk",
        cause=Cause("manipulators.blink", "eyes to wet"),
    )
