"""Bulges, in mm."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.face.head.face_coordinates import FaceCoordinates
from risorius.face.head.head import load_head
from risorius.face.skin.bulges import TAKEN_UP, Bulges, bulge_height, bulges
from risorius.face.solve import FaceSolver

from ..conftest import values_of

FOURTH = ((0, 0), (0, 1))  # kernels want points of four numbers
SWELL = {
    "cheek": {"zygomatic_major": 1.0, "orbicularis_oculi_orbitalis": 1.0},
    "chin": {"mentalis": 1.0},
    "glabella": {"corrugator_supercilii": 1.0},
    "forehead": {"frontalis_medialis": 1.0, "frontalis_lateralis": 1.0},
}
# mm, beside what the muscles' own fields swell.
LEAST = {"cheek": 0.29, "chin": 0.25, "glabella": 0.4, "forehead": 0.4}


@pytest.fixture(scope="module")
def lift(head, solver):
    """A function from targets to the bulges (N1,) in mm."""
    made = Bulges(head)

    def lifted(targets):
        solver.solve(values_of(targets))
        out = np.zeros(head.skin.matrix.shape[0])
        made.lift(np.pad(solver.coarse_skin, FOURTH), out)
        return out

    return lifted


@given(st.floats(0.3, 1.5), st.floats(1.0, 20.0), st.floats(0.2, 3.0))
def test_the_law_is_bounded_and_swells_with_compression(area, depth, cap):
    height = bulge_height(area, depth, cap)
    assert 0.0 <= height <= cap
    assert (height > 0.0) == (area < 1.0)
    assert bulge_height(area * 0.99, depth, cap) >= height


@given(st.floats(0.5, 0.85))
def test_volume_is_kept_but_for_what_the_flesh_takes_up(area):
    """Without its cap a bulge holds the lost volume: T·(1/J − 1), less the share that does not show."""
    lost = 1.0 / area - 1.0
    assert bulge_height(area, 10.0, 1e6) == pytest.approx(10.0 * lost * lost / (lost + TAKEN_UP), rel=1e-6)
    assert bulge_height(area, 10.0, 1e6) > 0.85 * 10.0 * lost


def test_nothing_swells_at_rest(lift):
    assert lift({}).max() < 1e-9


@pytest.mark.parametrize("name", SWELL)
def test_each_bulge_swells_under_its_muscles(name, lift, head, rest):
    marks, bulge = FaceCoordinates.of(head), bulges()[name]
    centre = (marks.mean(bulge.anchor) + np.array([*bulge.offset, 0.0])) * marks.unit
    near = np.linalg.norm(rest[:, :2] - centre[:2], axis=1) < max(bulge.size)
    heights = [lift({m: a * v for m, v in SWELL[name].items()})[near].max() for a in (0.25, 0.5, 1.0)]
    assert LEAST[name] < heights[2] <= bulge.cap * marks.unit
    assert heights == sorted(heights)


def test_a_smile_swells_the_cheeks_and_leaves_the_brow(lift, rest):
    swollen = lift(SWELL["cheek"])
    assert swollen[rest[:, 1] > 5.0].max() < 0.05


def test_bulges_are_mirrored(lift, fine_mirror):
    left = lift({"mentalis.left": 1.0, "zygomatic_major.left": 0.8, "corrugator_supercilii.left": 1.0})
    right = lift({"mentalis.right": 1.0, "zygomatic_major.right": 0.8, "corrugator_supercilii.right": 1.0})
    np.testing.assert_allclose(left, right[fine_mirror], atol=2e-3)


def test_raised_inner_brows_leave_the_glabella_flat(lift, rest):
    """Its skin is pushed together upwards; it swells where the brows are drawn together."""
    root = (np.abs(rest[:, 0]) < 4.0) & (rest[:, 1] > -5.0) & (rest[:, 1] < 18.0) & (rest[:, 2] > 20.0)
    assert lift({"frontalis_medialis": 1.0})[root].max() < 0.05
    assert lift({"corrugator_supercilii": 1.0})[root].max() > 0.3


def test_no_flesh_swells_into_an_eye():
    head = load_head("mei")
    solver, swollen = FaceSolver(head), np.zeros(head.skin.matrix.shape[0])
    solver.solve(values_of(SWELL["glabella"]))
    Bulges(head).lift(np.pad(solver.coarse_skin, FOURTH), swollen)
    rest = head.skin.matrix @ head.rest
    for centre, radius in zip(head.eye_centre, head.eye_radius, strict=True):
        assert swollen[np.linalg.norm(rest - centre, axis=1) - radius < 0.5].max() < 0.06
