"""Eyelashes on the lids' margins; they move with the lids."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..core.arrays import Array
from ..face.head.head import Head
from .strands import Strands, join
from .surface import Surface, unit

POINTS = 5
_SEED = 11
_LINE = 1.1  # mm from the upper margin to where the shade of the lashes' roots has faded by two thirds


def lash_shade(head: Head, points: Array) -> Array:
    """Return by how much, 0..1, skin at `points` (n, 3) is darkened by the roots of the upper lashes."""
    uppers = [points[pairs[:, 0]] for pairs in head.lid_pairs]
    margins = [_dense(_in_order(upper, way)) for upper, way in zip(uppers, (1.0, -1.0), strict=True)]
    distance, _ = cKDTree(np.concatenate(margins)).query(points)
    return np.asarray(np.exp(-((distance / _LINE) ** 2)))


def grow_lashes(
    head: Head, surface: Surface, colour: Array, skin: Array, upper: int = 130, lower: int = 40
) -> Strands:
    """Return `upper` and `lower` lashes of linear albedo `colour` (3,) for each eye, over that of `skin`."""
    groups, faint = [], colour + 0.5 * (skin - colour)  # lower lashes are finer than a pixel
    for side in range(2):
        pairs = surface.points[head.lid_pairs[side]]
        rng = np.random.default_rng(_SEED)
        groups.append(_row(surface, pairs[:, 0], head.eye_centre[side], upper, 5.8, 1.0, colour, rng))
        groups.append(_row(surface, pairs[:, 1], head.eye_centre[side], lower, 2.4, -1.0, faint, rng))
    return join(groups)


def _row(
    surface: Surface,
    margin: Array,
    centre: Array,
    count: int,
    longest: float,
    up: float,
    colour: Array,
    rng: np.random.Generator,
) -> Strands:
    """Return one row along a margin (P, 3) mm: short at both ends, fanned, curled."""
    outward = 1.0 if centre[0] > 0 else -1.0
    line = _in_order(margin, outward)
    place = np.clip(
        0.10 + 0.85 * (np.arange(count) + 0.6 * rng.standard_normal(count)) / (count - 1), 0.06, 0.96
    )
    at = place * (len(line) - 1)
    root = np.stack([np.interp(at, np.arange(len(line)), line[:, c]) for c in range(3)], axis=1)
    length = longest * (0.25 + 0.75 * np.sin(np.pi * (0.06 + 0.9 * place**1.1)) ** 1.5)
    length *= 0.7 + 0.4 * rng.random(count)
    ahead = unit(root - centre)
    fan = (place - 0.38) * 0.75 + rng.normal(0, 0.07, count)
    # Lashes leave the lid forwards and a little towards the other lid, and then curl away from it.
    dip = np.full(count, (-0.42 if up > 0 else -0.10) * up)
    start = ahead + np.stack([outward * fan, dip, np.zeros(count)], axis=1)
    way = np.linspace(0.0, 1.0, POINTS)
    curl = np.array([0.0, up * (0.95 if up > 0 else 0.75), 0.0])
    directions = unit(unit(start)[:, None, :] + curl * (way[None, :, None] ** 1.2))
    steps = directions[:, :-1] * (length / (POINTS - 1))[:, None, None]
    curves = root[:, None, :] + np.concatenate([np.zeros((count, 1, 3)), np.cumsum(steps, axis=1)], axis=1)
    triangles, weights = surface.nearest(root)
    curves += (surface.at(triangles, weights)[0] - root)[:, None, :]
    widths = np.tile((0.10 if up > 0 else 0.05) * (1 - 0.92 * way**1.3), (count, 1))
    return surface.root(
        triangles, weights, curves, widths, np.tile(colour, (count, 1)), np.full(count, 0.3), 0.0
    )


def _in_order(margin: Array, outward: float) -> Array:
    """Return the points (P, 3) of a lid's margin from the inner to the outer corner: `outward` is 1 or -1."""
    return margin[np.argsort(margin[:, 0] * outward, kind="stable")]


def _dense(line: Array) -> Array:
    """Return points (k, 3) along a line (P, 3), eight to each of its pieces."""
    at = np.linspace(0.0, len(line) - 1.0, 8 * (len(line) - 1) + 1)
    return np.stack([np.interp(at, np.arange(len(line)), line[:, c]) for c in range(3)], axis=1)
