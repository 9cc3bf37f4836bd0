from __future__ import annotations

import numpy as np
import pytest

from risorius.face.numerics.stiffness import REST, edges, laplacian
from risorius.face.skin.network import Network, pull


@pytest.fixture(scope="module")
def network(head):
    return Network.of(head)


def test_each_edge_is_there_once():
    quads = np.array([[0, 1, 2, 3], [1, 4, 5, 2]])
    assert edges(quads).tolist() == [[0, 1], [0, 3], [1, 2], [1, 4], [2, 3], [2, 5], [4, 5]]
    np.testing.assert_allclose(laplacian(6, quads) @ np.ones(6), 0.0)


def test_the_lips_and_what_no_muscle_moves_are_its_border(head, network):
    assert (head.masks["lips"][network.free] <= 0.5).all()
    assert (head.masks["ears"][network.free] < 1.0).any()
    cheek = np.argmin(np.linalg.norm(head.rest - [40.0, -45.0, 5.0], axis=1))
    assert cheek in network.free
    crown = np.argmax(head.rest[:, 1])
    assert crown not in network.free


def test_springs_pull_towards_the_neighbours_and_the_rest(network):
    count = len(network.free)
    points = np.random.default_rng(1).normal(size=(count, 4))
    out = np.zeros((count, 4))
    pull(network.start, network.column, network.weight, points, 2.0, out)
    np.testing.assert_allclose(out[:, :3], 2.0 * (network.stiffness @ points)[:, :3], atol=1e-12)
    assert network.stiffness.sum(axis=1).min() >= REST - 1e-12
