"""Timing of mouth shapes as in Rhubarb Lip Sync 1.14: pauses, and shapes in between.

Figures from its sources (Wolf, pauseAnimation.cpp, tweening.cpp, animationRules.cpp): a short pause holds or
relaxes the mouth, and a mouth that closes, or rounds, goes by a shape in between for 0.04 to 0.08 s.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from .visemes import Cue

IDLE = "X"
HELD, RELAXED = 0.12, 0.35  # s: pauses shorter than this hold the shape before, up to this relax it
SHORTEST, LONGEST = 0.04, 0.08  # s that a shape in between lasts
RELAXES = dict(zip("ABCDEFGHX", "ABBCCBXBX", strict=True))
# The shape between two shapes, and its time: before the change, about it, or after it.
BETWEEN = {
    "DA": ("C", "before"),
    "DB": ("C", "about"),
    "DG": ("C", "before"),
    "DX": ("C", "after"),
    "CF": ("E", "about"),
    "FC": ("E", "about"),
    "DF": ("E", "about"),
    "HF": ("E", "after"),
    "FH": ("E", "before"),
}
# Shares of the shape before and of the shape after that the one in between may take.
_SHARES = {"before": (1 / 3, 0.0), "about": (1 / 8, 1 / 8), "after": (0.0, 1 / 3)}
_EXACT = 1e-9  # s: a smaller difference between durations is rounding


def paused(cues: Sequence[Cue]) -> list[Cue]:
    """Return the cues with the mouth held or relaxed in pauses between two others."""
    result = list(cues)
    for k in range(1, len(cues) - 1):
        if cues[k].shape == IDLE:
            shape = _in_pause(cues[k - 1].shape, cues[k + 1].shape, cues[k].end - cues[k].start)
            result[k] = Cue(cues[k].start, cues[k].end, shape)
    return list(_joined(result))


def tweened(cues: Sequence[Cue]) -> list[Cue]:
    """Return the cues with shapes in between put in."""
    starts = [cue.start for cue in cues]
    ends = [cue.end for cue in cues]
    result: list[Cue] = []
    for k, cue in enumerate(cues):
        between = BETWEEN.get(cue.shape + cues[k + 1].shape) if k + 1 < len(cues) else None
        taken = _taken(cue, cues[k + 1], between[1]) if between else None
        if between and taken:
            ends[k], starts[k + 1] = cue.end - taken[0], cue.end + taken[1]
        result.append(Cue(starts[k], ends[k], cue.shape))
        if between and taken:
            result.append(Cue(ends[k], starts[k + 1], between[0]))
    return result


def _in_pause(before: str, after: str, seconds: float) -> str:
    if seconds < HELD - _EXACT:
        return before
    if seconds <= RELAXED + _EXACT:
        # One that is not what comes next, or there would be no pause to see.
        shape = RELAXES[before]
        while shape == after and RELAXES[shape] != shape:
            shape = RELAXES[shape]
        if shape != after:
            return shape
    return IDLE


def _taken(first: Cue, second: Cue, when: str) -> tuple[float, float] | None:
    """Return the seconds that a shape in between takes of both, None if it would be too short."""
    before, after = _SHARES[when]
    rooms = [
        (cue.end - cue.start) * (before + after) for cue, share in ((first, before), (second, after)) if share
    ]
    length = min(*rooms, LONGEST, LONGEST)
    if length < SHORTEST - _EXACT:
        return None
    return length * before / (before + after), length * after / (before + after)


def _joined(cues: Sequence[Cue]) -> Iterator[Cue]:
    last = cues[0]
    for cue in cues[1:]:
        if cue.shape == last.shape:
            last = Cue(last.start, cue.end, last.shape)
        else:
            yield last
            last = cue
    yield last
