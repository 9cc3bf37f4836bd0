"""Relief of the mesh in folds: creases go down, shoulders up, and a narrow crease keeps its room.

Where the ground is a narrow crease, as beside the wing of the nose, the skin of both its sides rises towards
the middle, and folds that lie beside each other add up. There they rise less: all of them together at their
caps narrow no face of the mesh at rest by more than a share of its width, because the muscles may have
narrowed it before.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...core.arrays import Array
from ..head.face_coordinates import FaceCoordinates
from ..head.head import Head
from ..muscles.fold_prevention import LEAST_WIDTH, Distances, altitudes
from ..numerics.quads import quad_normals
from .wrinkle_layouts import Fold
from .wrinkle_regions import PlacedRegion

NARROWED = 0.5 * LEAST_WIDTH  # share of a face's width: half of what the muscles leave
ROUNDS = 3  # of smoothing, so that the relief falls off towards a crease without a step


def relief(head: Head, placed: Sequence[PlacedRegion]) -> Array:
    """Return the share of the height of each region's fold that the mesh moves by, region after region.

    One number for each vertex in the region's mask, as `Compression` has its rows.
    """
    count, unit = head.skin.matrix.shape[0], FaceCoordinates.of(head).unit
    inside = [p.zone.mask > 0.0 for p in placed]
    shares = [_share(p)[rows] for p, rows in zip(placed, inside, strict=True)]
    full = np.zeros(count)
    for p, rows, share in zip(placed, inside, shares, strict=True):
        full[rows] += share * p.zone.mask[rows] * p.region.sizes.cap * unit
    room = _room(head, full)
    return np.concatenate([share * room[rows] for share, rows in zip(shares, inside, strict=True)])


def _share(placed: PlacedRegion) -> Array:
    phase, share = placed.phase, placed.region.sizes.relief
    if isinstance(placed.region.layout, Fold):
        beyond = np.maximum(phase, 0.0) / 0.35
        return share * (beyond * np.exp(1.0 - beyond) - 0.25 * np.exp(-((phase / 0.16) ** 2)))
    return -0.5 * share * np.cos(2.0 * np.pi * phase)


def _room(head: Head, full: Array) -> Array:
    """Return the share (N1,), 1 almost everywhere, of a rise by `full` (N1,) mm for which there is room."""
    rest = head.skin.matrix @ head.rest
    quads = head.skin.quads[(full != 0.0)[head.skin.quads].any(axis=1)]
    widths = Distances.of(altitudes(quads), rest)
    narrowed = widths.shortened(full[:, None] * quad_normals(rest, quads))
    share = np.minimum(1.0, NARROWED * widths.length / np.maximum(narrowed, 1e-9))
    room = np.ones(len(rest))
    for corner in widths.points.T:
        np.minimum.at(room, corner, share)
    for _ in range(ROUNDS):
        middles = room[quads].mean(axis=1)
        total, times = np.zeros(len(rest)), np.zeros(len(rest))
        for corner in quads.T:
            np.add.at(total, corner, middles)
            np.add.at(times, corner, 1.0)
        used = times > 0.0
        room[used] = np.minimum(room[used], total[used] / times[used])
    return room
