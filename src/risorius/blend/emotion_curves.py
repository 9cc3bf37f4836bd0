"""The curves of the emotion channel alone, as if nothing else moved the face."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from ..core.channels import POSTURE_LAYER
from ..core.parameters import MUSCLES, NEUTRAL
from ..core.score import Score
from .plan import Plan

_EMOTION = "emotion"
_MUSCLES = frozenset(p.name for p in MUSCLES)


def emotion_curves(score: Score, times: Array) -> Array:
    """Return the muscles that emotions alone move at the times, seconds: shape (n,) -> (n, 46).

    The posture that a speaker always shows does not count. All parameters but muscles are at rest. Raises
    InputError or ParameterError if the score cannot be performed.
    """
    shown = tuple(m for m in score.movements if m.channel == _EMOTION and m.layer != POSTURE_LAYER)
    if not shown:
        return np.tile(NEUTRAL, (len(times), 1))
    return Plan(Score(score.duration, shown, settings=score.settings)).at(times, _MUSCLES)
