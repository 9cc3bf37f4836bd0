from __future__ import annotations

import numpy as np
import pytest

from risorius.face.head.coupled_muscles import NO_LINKS
from risorius.face.head.head import load_head
from risorius.face.muscles.fold_prevention import (
    LEAST,
    STEEPEST,
    SWEEPS,
    Distances,
    FoldPrevention,
    altitudes,
    resolve_folds,
    struts,
)
from risorius.face.muscles.muscles import MuscleFields
from risorius.face.solve import FaceSolver

from ..conftest import MOUTH_MUSCLES, values_of
from ..flips import Flips


@pytest.fixture(scope="module")
def crowding(head):
    return FoldPrevention.of(head)


def displaced(solver, targets):
    out = np.zeros_like(solver.head.rest)
    MuscleFields.of(solver.head).displace(values_of(targets), out)
    return out


def test_struts_are_sides_and_diagonals_once():
    quads = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])
    assert len(struts(quads)) == 7 + 4
    assert [1, 2] in struts(quads).tolist()


@pytest.mark.parametrize("muscle", [*MOUTH_MUSCLES, "depressor_supercilii", "levator_palpebrae"])
def test_a_muscle_alone_is_left_as_it_is(head, crowding, solver, muscle):
    alone = displaced(solver, {muscle: 1.0})
    kept = alone.copy()
    crowding.resolve(kept)
    np.testing.assert_allclose(kept, alone, atol=1e-9)


def test_what_many_muscles_crowd_keeps_its_room(head, crowding):
    solver = FaceSolver(head, NO_LINKS)
    crowded = displaced(solver, dict.fromkeys(("mentalis", "depressor_labii", "zygomatic_major"), 1.0))
    before = (crowding.distances.shortened(crowded) - crowding.allowance).max()
    crowding.resolve(crowded)
    after = (crowding.distances.shortened(crowded) - crowding.allowance).max()
    assert before > 0.3
    assert after < 0.1


def test_one_edge_is_pushed_apart_evenly():
    points, way = np.array([[0, 1, 1]], np.int32), np.array([[1.0, 0.0, 0.0]])
    moved = np.array([[3.0, 0.5, 0.0], [0.0, 0.0, 0.2]])
    resolve_folds(points, np.zeros(1), way, np.array([2.0]), 4, np.empty(1, np.uint32), moved)
    np.testing.assert_allclose(moved, [[2.5, 0.5, 0.0], [0.5, 0.0, 0.2]])
    assert 0.0 < LEAST < 1.0


def test_a_narrow_face_is_kept_from_turning_over():
    """Its long sides slide over each other, and no edge of it grows shorter along its own direction."""
    rest = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [5.0, 1.0, 0.0], [1.0, 1.0, 0.0]])
    widths = Distances.of(altitudes(np.array([[0, 1, 2, 3]])), rest)
    np.testing.assert_allclose(widths.length[np.abs(widths.way[:, 1]) > 0.99], 1.0)
    moved = np.array([[0.0, 1.4, 0.0], [0.0, 1.4, 0.0], [3.0, 0.0, 0.0], [3.0, 0.0, 0.0]])
    assert widths.shortened(moved).max() > 1.0
    allowance = 0.6 * widths.length
    resolve_folds(
        widths.points, widths.foot, widths.way, allowance, 40, np.empty(len(allowance), np.uint32), moved
    )
    assert (widths.shortened(moved) - allowance).max() < 0.05
    assert (rest + moved)[3, 1] > (rest + moved)[0, 1]


# An upper lid between the brow, drawn down and in, and the lid's levator: it was laid over, or very nearly.
CREASED = [
    ("mei", None, {"frontalis_medialis": 0.69, "depressor_supercilii": 1.0, "levator_palpebrae": 0.93}),
    ("olaf", 75, {"depressor_supercilii": 0.97, "corrugator_supercilii": 0.9, "levator_palpebrae": 0.7}),
    (  # the brow is lowered by the joint field of its depressor and the ring of the eye, too
        "mei",
        None,
        {
            "depressor_supercilii": 0.857,
            "corrugator_supercilii": 0.866,
            "levator_palpebrae": 0.984,
            "orbicularis_oculi_orbitalis": 0.18,
        },
    ),
]


@pytest.mark.parametrize(("name", "age", "pose"), CREASED)
def test_a_lid_below_a_lowered_brow_is_not_laid_over(name, age, pose):
    head = load_head(name, age=age)
    one_sided = {f"{muscle}.right": value for muscle, value in pose.items()}
    assert Flips(head).count(FaceSolver(head).solve(values_of(one_sided)).skin) == 0


def test_distances_that_are_far_from_their_limit_are_met_too(head, crowding, solver):
    """Sweeps between those over all distances look at the close ones only: as many sweeps over all do."""
    crowded = displaced(solver, dict.fromkeys((*MOUTH_MUSCLES, "depressor_supercilii", "masseter"), 1.0))
    found, one_by_one = crowding.distances, crowded.copy()
    for _ in range(SWEEPS):
        resolve_folds(found.points, found.foot, found.way, crowding.allowance, 1, crowding.close, one_by_one)
    pushed = crowded.copy()
    crowding.resolve(pushed)
    assert np.linalg.norm(pushed - crowded, axis=1).max() > 0.3
    np.testing.assert_allclose(pushed, one_by_one, atol=0.05)


def test_no_corner_leaves_its_face_steeply(crowding, head):
    """Corners that come near the edge across are kept in their face's plane too, to either side."""
    found = crowding.distances
    first, second, third = (head.rest[found.points[:, k]] for k in range(3))
    out = np.abs((found.way * np.cross(third - second, first - second)).sum(axis=1)) > 1e-9
    flat = np.abs((found.way * (third - second)).sum(axis=1)) < 1e-9
    tilts = out & flat
    assert tilts.sum() > 100
    assert (crowding.allowance[tilts] >= STEEPEST * found.length[tilts] - 1e-9).all()
