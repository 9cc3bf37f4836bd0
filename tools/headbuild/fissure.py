"""The opening between the lids: the eyes stand in it, and the lids about the iris, as people's do.

The source puts the eyeballs of men, of old ones above all, more than two millimetres too high: their upper
lids hang to the pupils while white shows below the irises.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from risorius.core.arrays import AnyArray
from risorius.face.head.identity import OLD, YOUNG
from risorius.face.numerics.subdivide import catmull_clark
from risorius.looks.eyeball import IRIS

from .bust import Bust
from .lids import lid_pairs

# mm on an eye whose iris has a radius of 5.9. People's upper lids stand 3.5 mm above the middle of the pupil,
# and lower with age; their lower lids 5.2 mm below it (Rana et al. 2023, 380 people, 58 years on average; in
# 380 Koreans 3.2 to 3.3 from 20 to 60 years and less after, and 5.3 to 5.7). The bounds are ours.
PEOPLE = 5.9
LOWEST_UPPER = (3.6, 3.1)  # of a young and of an old head
HIGHEST_UPPER = 4.5
LOWER = (-6.2, -5.0)
LOWEST_MIDDLE = -1.5  # of the opening, below the middle of the pupil

_FADE = 0.003  # the larger, the nearer to the lids the skin stays
_HOLD = 50.0
_SWEEPS = 4  # the margins are moved by what they lack: what subdivision smooths away is added again


def set_eyes(bust: Bust, age: float) -> Bust:
    """The bust with eyes and lids where those of people of this `age` are."""
    unit = float(IRIS) * float(bust.eye_radius.mean()) / PEOPLE
    upper, lower = _heights(bust) / unit
    lowered = bust.body + np.array([0.0, max(LOWEST_MIDDLE - 0.5 * (upper + lower), 0.0) * unit, 0.0])
    result = replace(bust, body=lowered)
    return result.reshaped(_set_lids(result, bust.rest, age, unit))


def _set_lids(bust: Bust, before: AnyArray, age: float, unit: float) -> AnyArray:
    """Positions (N0, 3) with the lids' margins in their bounds, and as far from the eyeball as `before`."""
    old = (age - YOUNG) / (OLD - YOUNG)
    lowest = LOWEST_UPPER[0] + old * (LOWEST_UPPER[1] - LOWEST_UPPER[0])
    bounds = np.array([[lowest, HIGHEST_UPPER], LOWER]) * unit
    points = bust.rest.copy()
    for _ in range(_SWEEPS):
        heights = _heights(bust.reshaped(points))
        lack = np.clip(heights, *bounds.T) - heights
        held, move = np.zeros(len(points)), np.zeros_like(points)
        for side, centre in zip(("left", "right"), bust.eye_centre, strict=True):
            pairs = lid_pairs(bust, side)
            gap = points[pairs[:, 0], 1] - points[pairs[:, 1], 1]
            share = np.maximum(gap, 0.0) / gap.max()
            for margin, way in zip(pairs.T, lack, strict=True):
                held[margin] = 1.0
                move[margin, 1] = share * way
                far = np.linalg.norm(before[margin] - centre, axis=1)
                aside = (points[margin] + move[margin] - centre)[:, :2]
                depth = np.sqrt(np.maximum(far**2 - (aside**2).sum(axis=1), 0.0))
                move[margin, 2] = centre[2] + depth - points[margin, 2]
        points += _spread(bust, held, move)
    return points


def _heights(bust: Bust) -> AnyArray:
    """Heights (2,) in mm of the upper and the lower margin above the left pupil, on the subdivided skin."""
    pairs, centre = lid_pairs(bust, "left"), bust.eye_centre[0]
    rows = catmull_clark(len(bust.ids), bust.quads).matrix
    upper, lower = (rows[margin] @ bust.rest - centre for margin in pairs.T)
    return np.array([np.interp(0.0, margin[:, 0], margin[:, 1]) for margin in (upper, lower)])


def _spread(bust: Bust, held: AnyArray, move: AnyArray) -> AnyArray:
    """`move` (N0, 3) nearly kept where `held` is 1, fading off by the least bending elsewhere."""
    curvature = sp.diags(1.0 / bust.laplacian.diagonal()) @ bust.laplacian
    system = curvature.T @ curvature + _FADE * sp.identity(len(held)) + sp.diags(_HOLD * held)
    return np.asarray(splu(system.tocsc()).solve(_HOLD * held[:, None] * move))
