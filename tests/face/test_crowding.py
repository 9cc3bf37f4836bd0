from __future__ import annotations

import numpy as np
import pytest

from risorius.face.crowding import LEAST, Crowding, relieve, struts
from risorius.face.links import NO_LINKS
from risorius.face.solve import FaceSolver

from .conftest import MOUTH_MUSCLES, values_of


@pytest.fixture(scope="module")
def crowding(head):
    return Crowding.of(head)


def displaced(solver, targets):
    out = np.zeros_like(solver.head.rest)
    solver._muscles.displace(values_of(targets), out)
    return out


def shortened(crowding, displacement):
    a, b = crowding.edges.T
    return ((displacement[a] - displacement[b]) * crowding.way).sum(axis=1)


def test_struts_are_sides_and_diagonals_once():
    quads = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])
    assert len(struts(quads)) == 7 + 4
    assert [1, 2] in struts(quads).tolist()


@pytest.mark.parametrize("muscle", [*MOUTH_MUSCLES, "depressor_supercilii", "levator_palpebrae"])
def test_a_muscle_alone_is_left_as_it_is(head, crowding, solver, muscle):
    alone = displaced(solver, {muscle: 1.0})
    kept = alone.copy()
    crowding.relieve(kept)
    np.testing.assert_allclose(kept, alone, atol=1e-9)


def test_what_many_muscles_crowd_keeps_its_room(head, crowding):
    solver = FaceSolver(head, NO_LINKS)
    crowded = displaced(solver, dict.fromkeys(("depressor_supercilii", "levator_palpebrae", "AU1"), 1.0))
    before = (shortened(crowding, crowded) - crowding.room).max()
    crowding.relieve(crowded)
    after = (shortened(crowding, crowded) - crowding.room).max()
    assert before > 0.3
    assert after < 0.1


def test_one_edge_is_pushed_apart_evenly():
    edges, way = np.array([[0, 1]], np.int32), np.array([[1.0, 0.0, 0.0]])
    moved = np.array([[3.0, 0.5, 0.0], [0.0, 0.0, 0.2]])
    relieve(edges, way, np.array([2.0]), 4, moved)
    np.testing.assert_allclose(moved, [[2.5, 0.5, 0.0], [0.5, 0.0, 0.2]])
    assert 0.0 < LEAST < 1.0
