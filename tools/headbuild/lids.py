"""The lids: which vertices of the margins meet, and a blink that ends where they do."""

from __future__ import annotations

import numpy as np

from risorius.core.arrays import AnyArray

from .bust import Bust
from .loops import columns, fill_inside

# An edge of the loop along the lids' margin (left eye), in the base mesh.
_MARGIN = (6784, 6785)
_CLEAR = 0.55  # mm: the subdivided margins come up to 0.15 mm nearer
_SCALES = (0.45, 0.75)  # least and greatest share of the sculpt that is used


def margin(bust: Bust) -> list[int]:
    """The loop (28 vertices) along the margins of the left eye's lids."""
    return bust.loop(*_MARGIN)


def lid_pairs(bust: Bust, side: str) -> AnyArray:
    """(14, 2) upper and lower vertices of the lids' margins that meet, left or right eye."""
    left = columns(margin(bust), bust.places)
    return left if side == "left" else bust.mirror[left]


def behind_lids(bust: Bust) -> AnyArray:
    """Vertices of the skin that lines the left eye's socket, within the margins of the lids."""
    back = bust.eye_centre[0] - np.array([0.0, 0.0, bust.eye_radius[0]])
    seed = int(np.linalg.norm(bust.rest - back, axis=1).argmin())
    return fill_inside(bust.loops, bust.quads, seed, margin(bust))


def close_lids(bust: Bust, rest: AnyArray, field: AnyArray, side: str) -> AnyArray:
    """Change the sculpted blink `field` (N0, 3) so that at 1 the margins just meet, column by column.

    The sculpt closes too far towards the outer corner and not far enough at the inner one: there it is scaled
    down, here each margin goes half of the way that is left and takes its surroundings along.
    """
    pairs = lid_pairs(bust, side)
    x = rest[pairs].mean(axis=1)[:, 0]
    order = np.argsort(x)
    scale = np.clip(_gap(rest, pairs) / np.maximum(_gap(-field, pairs), 1e-6), *_SCALES)
    share: AnyArray = np.interp(rest[:, 0], x[order], scale[order])
    closed = rest + field * share[:, None]
    on_margin, this_side = np.zeros(len(rest)), np.sign(rest[:, 0]) == np.sign(x.mean())
    on_margin[pairs] = 1.0
    for _ in range(4):
        left = np.zeros(len(rest))
        left[pairs] = 0.5 * _gap(closed, pairs)[:, None] * np.array([-1.0, 1.0])
        closed[:, 1] += bust.spread(on_margin, left, hold=5.0, fade=0.1) * this_side
    return np.asarray(closed - rest)


def _gap(points: AnyArray, pairs: AnyArray) -> AnyArray:
    return np.asarray(points[pairs[:, 0], 1] - points[pairs[:, 1], 1])


def clear_of_eyes(bust: Bust) -> AnyArray:
    """Positions (N0, 3) of the bust with its lids' margins at least `_CLEAR` mm before the eyeballs."""
    points = bust.rest.copy()
    for side, centre, radius in zip(("left", "right"), bust.eye_centre, bust.eye_radius, strict=True):
        ring = np.unique(lid_pairs(bust, side))
        ahead = points - centre
        distance = np.linalg.norm(ahead, axis=1)
        short, held = np.zeros(len(points)), np.zeros(len(points))
        short[ring], held[ring] = np.maximum(_CLEAR + radius - distance[ring], 0.0), 1.0
        if short.any():
            push = np.maximum(bust.spread(held, short, hold=50.0, fade=0.2), 0.0)
            points += (push / distance)[:, None] * ahead
    return points
