"""Head and gaze: what the script marks, and the small movements of a living head (paper A, channels 5, 6).

Amplitudes are small against speech's own (facts: science/07: SD of rotation 3.3, 0.9, 0.8 degrees while
speaking); saccades stay on the listener's face.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..core.movement import Cause, Movement
from ..rules.timing import saccade_duration
from .registry import CHANNEL_BUILDERS, Brief

# Standard deviations in degrees of the idle head's targets, and seconds from one to the next.
_HEAD_SD = {"head_pitch": 0.9, "head_yaw": 0.8, "head_roll": 0.6}
_HEAD_DWELL = (0.9, 2.2)
# Saccades between the listener's eyes and mouth, seen from 0.8 m: degrees.
_GAZE_SD = {"gaze_pitch": 0.9, "gaze_yaw": 1.3}
_GAZE_DWELL = (0.5, 2.4)
_LAYER = "idle"


@CHANNEL_BUILDERS.register("head")
def head(brief: Brief, rng: np.random.Generator) -> Iterator[Movement]:
    """Yield the marked head movements and a slow wander about the rest position."""
    yield from (m for m in brief.marks if m.channel == "head")
    if brief.lively:
        yield from _wander("head", brief.duration, _HEAD_SD, _HEAD_DWELL, rng)


@CHANNEL_BUILDERS.register("gaze")
def gaze(brief: Brief, rng: np.random.Generator) -> Iterator[Movement]:
    """Yield the marked gaze and small saccades about the listener's face."""
    yield from (m for m in brief.marks if m.channel == "gaze")
    if brief.lively:
        yield from _wander("gaze", brief.duration, _GAZE_SD, _GAZE_DWELL, rng)


def _wander(
    channel: str, duration: float, sd: dict[str, float], dwell: tuple[float, float], rng: np.random.Generator
) -> Iterator[Movement]:
    start = float(rng.uniform(0.0, dwell[0]))
    while start < duration:
        length = float(rng.uniform(*dwell))
        targets = {name: float(np.clip(rng.normal(0.0, s), -2.0 * s, 2.0 * s)) for name, s in sd.items()}
        amplitude = max(abs(v) for v in targets.values())
        onset = length if channel == "head" else saccade_duration(amplitude)
        yield Movement(
            channel,
            start,
            start + length + onset,
            onset,
            onset,
            targets,
            id=f"{channel}.idle@{start:.3f}",
            layer=_LAYER,
            function="minimum_jerk" if channel == "head" else "saccade",
            cause=Cause(f"{channel}.idle", "a living head"),
        )
        start += length
