"""Muscles' fields that would fold narrow skin over, as sculpts carried onto another face do at its lids."""

from __future__ import annotations

import numpy as np

from risorius.core.arrays import AnyArray
from risorius.face.muscles.fold_prevention import Distances, altitudes, resolve_folds, struts

from .bust import Bust

_LEFT = 0.5  # of an edge and of a face's width that a muscle alone leaves
_SWEEPS = 60
_INSIDE = 0.2  # of the masks of lips and mouth: there skin does fold, and meets
_MARGIN = 1.0  # mm from the eyeball: the lids' margins turn on it


def unfolded(bust: Bust, rest: AnyArray, field: AnyArray) -> AnyArray:
    """The field (N0, 3) with room left for the outer skin `rest` (N0, 3) that it would crowd."""
    edges, widths = struts(bust.quads), altitudes(bust.quads)
    points = np.vstack([edges[:, [0, 1, 1]], widths])
    found = Distances.of(points[_outside(bust, rest)[points].all(axis=1)], rest)
    moved = field.copy()
    close = np.empty(len(found.points), np.uint32)
    resolve_folds(found.points, found.foot, found.way, (1.0 - _LEFT) * found.length, _SWEEPS, close, moved)
    return moved


def _outside(bust: Bust, rest: AnyArray) -> AnyArray:
    hidden = np.maximum(bust.texture("lips"), bust.texture("inside-mouth")) > _INSIDE
    for centre, radius in zip(bust.eye_centre, bust.eye_radius, strict=True):
        hidden |= np.linalg.norm(rest - centre, axis=1) < radius + _MARGIN
    return ~hidden
