"""One blink, as people make it or as paper B describes it."""

from __future__ import annotations

from collections.abc import Sequence

from ..core.movement import Cause, Movement
from ..rules.match import LIDS
from ..rules.profiles import BlinkHabits
from ..rules.synchrony import MovementPhases, nearest, snapped

# Paper B, section 5.2: an eighth of a second of closure, 1/24 closed, 1/12 of aperture.
PAPER = (1 / 8, 1 / 24, 1 / 12)
# Lids close no faster (seconds).
FASTEST = 0.04


def blink(
    channel: str,
    start: float,
    depth: float,
    habits: BlinkHabits,
    boundaries: Sequence[float],
    cause: Cause,
    layer: str = "",
) -> Movement:
    """Return a blink that closes both eyes by `depth` 0..1 from `start` on, or the phoneme nearest to it."""
    span = (
        phonemic(start, boundaries) if habits.kinematics == "paper" else _measured(start, habits, boundaries)
    )
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


def phonemic(start: float, boundaries: Sequence[float]) -> MovementPhases:
    """Return paper B's blink: the phonemes closest to its average speed begin, hold and end it."""
    closing, closed, opening = PAPER
    plain = MovementPhases(
        start, start + closing, start + closing + closed, start + closing + closed + opening
    )
    found = snapped(plain, boundaries)
    apex = max(found.apex, found.start + FASTEST)
    release = max(found.release, apex)
    return MovementPhases(found.start, apex, release, max(found.end, release + FASTEST))


def _measured(start: float, habits: BlinkHabits, boundaries: Sequence[float]) -> MovementPhases:
    start = nearest(start, boundaries)
    apex = start + habits.closing
    release = apex + habits.closed
    return MovementPhases(start, apex, release, release + habits.opening)
