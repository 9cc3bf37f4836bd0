"""The openings of the face: the slit of the lips, and the lids' margins over the eyes."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from .materials.eye import LID_STEPS
from .materials.mouth import LIP_STEPS


def lip_edges(pairs: Array) -> tuple[Array, Array]:
    """Return the span (2,) of x and the slit (LIP_STEPS, 4): y and z of the upper and of the lower lip.

    `pairs` (P, 2, 3) mm are points of the upper and lower lip that touch when the mouth is shut. If
    several pairs have the same x, those with the smaller gap count, because they bound the light.
    """
    x = pairs[..., 0].mean(axis=1)
    grid = np.linspace(x.min(), x.max(), LIP_STEPS)
    gap = pairs[:, 0, 1] - pairs[:, 1, 1]
    width = max((x.max() - x.min()) / LIP_STEPS, 1e-6)
    weight = np.exp(-0.5 * ((grid[:, None] - x) / width) ** 2 - 0.5 * np.clip(gap - gap.min(), 0.0, 40.0))
    weight += 1e-12 * (np.abs(grid[:, None] - x) == np.abs(grid[:, None] - x).min(axis=1, keepdims=True))
    weight /= weight.sum(axis=1, keepdims=True)
    return np.array([x.min(), x.max()]), weight @ pairs[:, :, 1:].reshape(-1, 4)


def lid_margins(pairs: Array, centre: Array, radius: float) -> tuple[Array, Array]:
    """Return the span (2,) of x and the heights (LID_STEPS, 2) of the upper and lower margin over the eye.

    `pairs` (P, 2, 3) are the margins' points in the head frame; they are projected onto the
    eye's sphere from its centre.
    """
    points = pairs - centre
    points = points * (radius / np.linalg.norm(points, axis=-1, keepdims=True))
    upper, lower = points[:, 0], points[:, 1]
    span = np.array([max(upper[:, 0].min(), lower[:, 0].min()), min(upper[:, 0].max(), lower[:, 0].max())])
    x = np.linspace(span[0], span[1], LID_STEPS)
    return span, np.stack([_height(side, x) for side in (upper, lower)], axis=1)


def _height(margin: Array, x: Array) -> Array:
    order = np.argsort(margin[:, 0], kind="stable")
    return np.asarray(np.interp(x, margin[order, 0], margin[order, 1]))
