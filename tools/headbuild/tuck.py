"""The tuck of the lower lip: its upper edge goes to the edge of the upper incisors, as for f and v."""

from __future__ import annotations

import numpy as np

from risorius.core.arrays import AnyArray

from .jaw import Jaw
from .masks import smoothstep
from .mouth import LipSeal

MASSETER = 0.06  # opening of the jaw for which the lip just reaches the teeth
_PLACES = np.array([0.01, 3.0, 6.0])  # x in mm where the lip's crest is measured
_AHEAD = 0.8  # mm from the incisors' edge forward to the lip's crest


def tuck(rest: AnyArray, field: AnyArray, seal: LipSeal, jaw: Jaw, incisor: AnyArray) -> AnyArray:
    """Add to `field` (N0, 3) the shift of the lower lip that brings its crest under the `incisor` edge
    (3,) mm.
    """
    goal = incisor[1:] + np.array([-0.1, _AHEAD])
    corner = rest[seal.corner, 0]
    share = (
        2.0
        * np.maximum(-seal.share, 0.0)
        * (1.0 - smoothstep(0.55 * corner, 1.05 * corner, np.abs(rest[:, 0])))
    )
    result = field.copy()
    for _ in range(12):
        posed = jaw.turn(rest + result, jaw.weight * jaw.angle * MASSETER) + MASSETER * jaw.corrective
        crest = np.mean([seal.sections.crest(posed, x)[1:] for x in _PLACES], axis=0)
        result[:, 1:] += 0.8 * share[:, None] * (goal - crest)
    return result
