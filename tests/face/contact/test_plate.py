from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from risorius.face.contact.plate import REACH, nearby, plate_compliance, stiffness

SIDE = 15


@pytest.fixture(scope="module")
def plate():
    """The stiffness of a square grid, its response at its middle and at two vertices beside it, its quads."""
    index = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    quads = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    stiff = stiffness(SIDE * SIDE, quads)
    middle = SIDE * SIDE // 2
    points = sp.csr_matrix(
        (np.ones(3), (range(3), [middle, middle + 2, middle - SIDE])), shape=(3, SIDE * SIDE)
    )
    return stiff, points, plate_compliance(quads, points, np.ones(SIDE * SIDE, bool)), quads


def test_stiffness_is_symmetric_and_positive(plate):
    stiff = plate[0].toarray()
    np.testing.assert_allclose(stiff, stiff.T)
    assert np.linalg.eigvalsh(stiff).min() > 0.0


def test_response_is_the_inverse_of_the_stiffness(plate):
    stiff, points, found, _ = plate
    exact = np.linalg.inv(stiff.toarray()) @ points.T
    np.testing.assert_allclose(found.motion.T, exact[found.region], atol=1e-9)
    np.testing.assert_allclose(found.compliance, points @ exact, atol=1e-9)


def test_a_push_fades_with_distance(plate):
    along = plate[2].motion[0].max() * 0.5
    reached = plate[2].region[plate[2].motion[0] > along]
    middle = SIDE * SIDE // 2
    rows, columns = np.divmod(reached, SIDE)
    assert np.abs(rows - middle // SIDE).max() <= 5
    assert np.abs(columns - middle % SIDE).max() <= 5


def test_what_is_not_free_does_not_move(plate):
    _, points, _, quads = plate
    free = np.zeros(SIDE * SIDE, bool)
    free[SIDE * 4 : SIDE * 11] = True
    assert free[plate_compliance(quads, points, free).region].all()


def test_nearby_is_a_matter_of_distance():
    rest = np.array([[0.0, 0.0, 0.0], [REACH - 1.0, 0.0, 0.0], [REACH + 1.0, 0.0, 0.0]])
    assert nearby(rest, np.zeros((1, 3))).tolist() == [True, True, False]
