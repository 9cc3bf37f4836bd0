import numpy as np
import pytest

from risorius.looks.strands import Strands, join


@pytest.fixture
def hairs():
    """Two hairs of three points."""
    curves = np.arange(18, dtype=np.float32).reshape(2, 3, 3)
    roots, weights = np.zeros((2, 3), np.int32), np.full((2, 3), 1 / 3, np.float32)
    return Strands(
        roots,
        weights,
        curves,
        np.ones((2, 3), np.float32),
        np.ones((2, 3), np.float32),
        np.zeros(2, np.float32),
        np.zeros(2, np.float32),
        0.5,
    )


def test_each_triangle_tells_which_part_of_its_hair_it_is(hairs):
    assert hairs.segments().tolist() == [0, 0, 1, 1, 0, 0, 1, 1]
    assert len(hairs.segments()) == len(hairs.triangles())


def test_joined_hairs_keep_their_order(hairs):
    both = join([hairs, hairs])
    assert both.widths.shape == (4, 3)
    assert np.array_equal(both.curves[2:], hairs.curves)
    assert both.triangles().max() == both.vertices - 1
    assert len(both.triangles()) == 4 * 2 * 2
