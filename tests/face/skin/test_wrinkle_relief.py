from __future__ import annotations

import numpy as np

from risorius.face.head.face_coordinates import FaceCoordinates
from risorius.face.head.head import load_head
from risorius.face.muscles.fold_prevention import Distances, altitudes
from risorius.face.skin.wrinkle_regions import place_regions
from risorius.face.skin.wrinkle_relief import NARROWED, relief
from risorius.face.solve import FaceSolver

from ..conftest import values_of
from ..flips import Flips, normals

# A sneer and a smile of the same side: the folds beside the wing of the nose turned a face over.
CREASED = {
    "zygomatic_major.right": 0.91,
    "levator_labii_nasi.right": 0.95,
    "depressor_glabellae.right": 0.84,
    "corrugator_supercilii.right": 0.92,
    "orbicularis_oculi_palpebralis.right": 0.88,
}


def risen(head):
    """The rise (N1, 3) in mm of all folds together at their caps, along the normals at rest."""
    placed, unit, rest = place_regions(head), FaceCoordinates.of(head).unit, head.skin.matrix @ head.rest
    inside = [p.zone.mask > 0.0 for p in placed]
    shares = np.split(relief(head, placed), np.cumsum([rows.sum() for rows in inside])[:-1])
    full, outwards = np.zeros(len(rest)), np.zeros_like(rest)
    for p, rows, share in zip(placed, inside, shares, strict=True):
        full[rows] += share * p.zone.mask[rows] * p.region.sizes.cap * unit
    for corner in head.skin.quads.T:
        np.add.at(outwards, corner, normals(rest, head.skin.quads))
    return full[:, None] * outwards / np.linalg.norm(outwards, axis=1, keepdims=True)


def test_folds_leave_room_in_creases_and_rise_elsewhere(head, rest):
    up = risen(head)
    widths = Distances.of(altitudes(head.skin.quads), rest)
    assert (widths.shortened(up) - NARROWED * widths.length).max() < 1e-9
    assert np.linalg.norm(up, axis=1).max() > 3.0


def test_the_crease_of_the_noses_wing_does_not_turn_over():
    amara = load_head("amara")
    assert Flips(amara).count(FaceSolver(amara).solve(values_of(CREASED)).skin) == 0
