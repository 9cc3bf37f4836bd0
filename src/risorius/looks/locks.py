"""What all styles of hair share: how high hairs run over the skin, their smoothness, and their locks."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..core.arrays import Array
from .surface import Surface, unit

_LOCKS = 700
_EVEN = 0.35  # of the points of a curve, the weight of those spread evenly beside those where it bends


def height_over_skin(tree: cKDTree, surface: Surface, places: Array) -> tuple[Array, Array]:
    """Return how high (S,) places (S, 3) stand over the skin, and its normals (S, 3) there.

    Both are means of the nearest vertices: taking one alone would break hairs where it changes.
    """
    distance, nearest = tree.query(places, k=5)
    weight = 1.0 / (distance + 0.5)
    weight /= weight.sum(axis=1, keepdims=True)
    normal = unit(np.einsum("sk,skc->sc", weight, surface.normals[nearest]))
    foot = np.einsum("sk,skc->sc", weight, surface.points[nearest])
    return np.einsum("sc,sc->s", places - foot, normal), normal


def smoothed(curves: Array, rounds: int = 2) -> Array:
    """Return curves (S, P, 3) with their inner points drawn to the middle of their neighbours."""
    curves = curves.copy()
    for _ in range(rounds):
        curves[:, 1:-1] = 0.25 * curves[:, :-2] + 0.5 * curves[:, 1:-1] + 0.25 * curves[:, 2:]
    return curves


def respaced(curves: Array, points: int) -> tuple[Array, Array]:
    """Return curves (S, P, 3) by `points` of theirs, close where they bend, and how far along (S, points).

    The way along a curve runs from 0 at its root to 1.
    """
    steps = np.diff(curves, axis=1)
    lengths = np.linalg.norm(steps, axis=2) + 1e-9
    bends = _bends(steps / lengths[..., None])
    even = lengths / lengths.sum(axis=1, keepdims=True)
    shares = _summed(_EVEN * even + bends / (bends.sum(axis=1, keepdims=True) + 1.0))
    way = _summed(lengths)[..., None]
    return _at_shares(curves, shares, points), _at_shares(way, shares, points)[..., 0]


def _bends(ways: Array) -> Array:
    """Return by how many radians (S, P) parts of unit directions (S, P, 3) turn, half of it at either end."""
    cosines = np.einsum("spc,spc->sp", ways[:, :-1], ways[:, 1:])
    turns = np.pad(np.arccos(np.clip(cosines, -1.0, 1.0)), ((0, 0), (1, 1)))
    return np.asarray(0.5 * (turns[:, :-1] + turns[:, 1:]))


def _summed(parts: Array) -> Array:
    """Return how much (S, P + 1) lies before each point, of what the parts (S, P) between them come to."""
    before = np.pad(np.cumsum(parts, axis=1), ((0, 0), (1, 0)))
    return np.asarray(before / before[:, -1:])


def _at_shares(values: Array, shares: Array, points: int) -> Array:
    """Return values (S, P, c), known where `shares` (S, P) rise from 0 to 1, at `points` even steps."""
    strands, known = shares.shape
    wanted = np.linspace(0.0, 1.0, points)
    upper = (shares[:, None, :] < wanted[None, :, None]).sum(axis=2).clip(1, known - 1)
    row = np.arange(strands)[:, None]
    low, high = shares[row, upper - 1], shares[row, upper]
    part = ((wanted - low) / np.maximum(high - low, 1e-12))[..., None]
    return np.asarray(values[row, upper - 1] * (1.0 - part) + values[row, upper] * part)


def gather_locks(
    curves: Array, length: Array, amount: Array, rng: np.random.Generator
) -> tuple[Array, Array]:
    """Draw hairs by `amount` (S,) to the guides of their locks, more at their tips; add each lock's shade."""
    count, points = curves.shape[:2]
    guides = rng.permutation(count)[: min(_LOCKS, count)]
    middle = curves[:, points // 2]
    _, mine = cKDTree(middle[guides]).query(middle)
    way = np.linspace(0.0, 1.0, points)[None, :, None]
    offset = curves - curves[:, :1]
    wanted = (
        offset[guides][mine] * (length / length[guides][mine])[:, None, None] + curves[guides][mine][:, :1]
    )
    drawn = curves + 0.6 * amount[:, None, None] * way**1.3 * (wanted - curves)
    return drawn, 0.82 + 0.36 * rng.random(len(guides))[mine]
