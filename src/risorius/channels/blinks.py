"""One blink, as people make it or as the sources of the two papers describe it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

from ..core.counter_rng import CounterRng
from ..core.movement import Cause, Movement
from ..rules.match import LIDS
from ..rules.profiles import BlinkHabits
from ..rules.synchrony import MovementPhases, nearest

# Paper B, section 5.2: an eighth of a second of closure, 1/24 closed, 1/12 of aperture.
PELACHAUD = (1 / 8, 1 / 24, 1 / 12)
# Itti, Dhavale and Pighin 2003, by their laboratory's code: 190 ms in all; how they are divided is ours.
ITTI = (0.06, 0.02, 0.11)


def blink(
    channel: str,
    start: float,
    depth: float,
    habits: BlinkHabits,
    boundaries: Sequence[float],
    cause: Cause,
    layer: str = "",
) -> Movement:
    """Return a blink that closes both eyes by `depth` 0..1 from `start` on, or the phoneme nearest to it.

    Itti's blinks begin when they are drawn, not where phonemes do.
    """
    if habits.model == "pelachaud":
        span = phonemic(start, boundaries)
    else:
        span = _timed(start if habits.model == "itti" else nearest(start, boundaries), _parts(habits))
    return Movement(
        channel,
        span.start,
        span.end,
        span.apex - span.start,
        span.end - span.release,
        dict.fromkeys(LIDS, depth),
        id=f"{cause.rule}@{span.start:.3f}",
        layer=layer,
        function="minimum_jerk",
        cause=cause,
    )


def blink_seconds(habits: BlinkHabits) -> float:
    """Return how long a blink lasts, on average where phonemes time it."""
    return sum(_parts(habits))


def _parts(habits: BlinkHabits) -> tuple[float, float, float]:
    """Return for how many seconds a blink closes, is closed and opens, on average where phonemes time it."""
    published = {"pelachaud": PELACHAUD, "itti": ITTI}
    return published.get(habits.model, (habits.closing, habits.closed, habits.opening))


def blink_depth(habits: BlinkHabits, numbers: CounterRng) -> float:
    """Return how far a blink closes the eyes, 0..1: a share of natural blinks is not complete."""
    if habits.model != "natural" or numbers.uniform("incomplete") >= habits.incomplete:
        return 1.0
    low, high = habits.depth
    return numbers.uniform("depth", low=low, high=high)


def phonemic(start: float, boundaries: Sequence[float]) -> MovementPhases:
    """Return paper B's blink: the phonemes whose times are the closest to its average speed begin, hold and
    end it.

    The eyes are shut, begin to open and are open again at the phonemes closest to these times after the
    start, if that leaves each part half of its average length at least; else it has its average length. So
    the eyes are closed for a while in every blink.
    """
    times = [nearest(start, boundaries)]
    for average, until in zip(PELACHAUD, accumulate(PELACHAUD), strict=True):
        end = nearest(times[0] + until, boundaries)
        times.append(end if end - times[-1] >= 0.5 * average else times[-1] + average)
    return MovementPhases(*times)


def _timed(start: float, parts: tuple[float, float, float]) -> MovementPhases:
    """Return a blink, by the seconds in which it closes, stays closed and opens."""
    closing, closed, opening = parts
    apex = start + closing
    return MovementPhases(start, apex, apex + closed, apex + closed + opening)
