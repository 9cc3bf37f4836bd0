"""What all styles of hair share: how high hairs run over the skin, their smoothness, and their locks."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from .attach import Surface, unit

Array = npt.NDArray[np.float64]
_LOCKS = 700


def over_skin(tree: cKDTree, surface: Surface, places: Array) -> tuple[Array, Array]:
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
