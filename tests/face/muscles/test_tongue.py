from __future__ import annotations

import numpy as np
import pytest

from risorius.face.muscles.jaw import Jaw
from risorius.face.muscles.tongue import TongueShapes

from ..conftest import values_of


@pytest.fixture(scope="module")
def tongue(head):
    return TongueShapes.of(head), Jaw.of(head)


def placed(tongue, opening=0.0, **targets):
    shapes, jaw = tongue
    return shapes.place(values_of(targets), jaw, opening)


def test_at_rest_it_is_the_subdivided_tongue(tongue, head):
    expected = head.tongue.subdivision.matrix @ head.tongue.rest
    np.testing.assert_allclose(placed(tongue), expected, atol=1e-12)


@pytest.mark.parametrize(
    ("name", "way"), [("tongue_up", (0, 1, 0)), ("tongue_out", (0, 0, 1)), ("tongue_back", (0, 0, -1))]
)
def test_each_shape_moves_the_tongue_its_way(tongue, name, way):
    half, full = placed(tongue, **{name: 0.5}), placed(tongue, **{name: 1.0})
    moved = (full - placed(tongue)) @ way
    assert moved.max() > 2.0
    np.testing.assert_allclose((half - placed(tongue)) @ way, 0.5 * moved, atol=1e-9)


def test_raised_it_goes_rigidly_with_the_jaw(tongue):
    closed, opened = placed(tongue, tongue_up=1.0), placed(tongue, 0.8, tongue_up=1.0)
    np.testing.assert_allclose(opened, tongue[1].carry(closed, 0.8), atol=1e-12)


def test_it_stands_for_consonants_and_lies_down_in_the_open_mouth(tongue):
    shapes, jaw = tongue
    np.testing.assert_allclose(placed(tongue, 0.1), jaw.carry(placed(tongue), 0.1), atol=1e-12)
    lowered = [(jaw.carry(shapes.rest, o) - placed(tongue, o))[:, 1].max() for o in (0.2, 0.5, 1.0)]
    assert 0.5 < lowered[0] < lowered[1] < lowered[2]
    assert lowered[2] > 10.0


def test_in_the_open_mouth_its_edges_lie_lower_than_its_middle(tongue):
    shapes, _ = tongue
    x = np.abs(shapes.rest[:, 0])
    lowered = -shapes.lying[:, 1]
    for z in np.arange(-40.0, 0.0, 10.0):
        slice_ = np.abs(shapes.rest[:, 2] - z) < 5.0
        top = shapes.rest[:, 1] > np.median(shapes.rest[slice_, 1])
        middle, edge = slice_ & top & (x < 4.0), slice_ & (x > 0.8 * x[slice_].max())
        highest = (shapes.rest[:, 1] - lowered)[middle].max()
        assert highest - (shapes.rest[:, 1] - lowered)[edge].max() > 2.0
