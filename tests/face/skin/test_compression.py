"""Compression: stretch along a direction, and of area, of patches of skin."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.face.numerics.rotations import head_rotation
from risorius.face.skin.compression import Compression, Zone
from tests.profiles import examples


@pytest.fixture(scope="module")
def zones(head, rest):
    """A vertical and an area zone over the forehead."""
    mask = np.clip((rest[:, 1] - 20.0) / 10.0, 0.0, 1.0) * (rest[:, 1] < 60.0) * (rest[:, 2] > 0.0)
    up = np.tile([0.0, 1.0, 0.0], (len(head.quads), 1))
    return Compression.of(head, [Zone(mask, up), Zone(mask, np.zeros_like(up))])


def measured(zones, skin):
    out = zones.measure(skin, np.empty(len(zones.row_vertex)))
    return [out[zones.row_zone == k] for k in range(zones.zones)]


@examples(20)
@given(angles=st.tuples(*[st.floats(-30.0, 30.0)] * 3), shift=st.floats(-50.0, 50.0))
def test_skin_that_only_moves_is_not_compressed(zones, head, angles, shift):
    for values in measured(zones, head.rest @ head_rotation(*angles).T + shift):
        np.testing.assert_allclose(values, 1.0, atol=1e-9)


@examples(20)
@given(scale=st.floats(0.6, 1.02))
def test_uniform_scaling_is_measured_exactly(zones, head, scale):
    along, area = measured(zones, head.rest * scale)
    np.testing.assert_allclose(along, scale, rtol=1e-9)
    np.testing.assert_allclose(area, scale**2, rtol=1e-9)


def test_stretching_across_leaves_the_measured_direction_alone(zones, head):
    along, area = measured(zones, head.rest * [0.8, 1.0, 1.0])
    assert np.abs(along - 1.0).max() < 0.07  # the forehead slopes: up is not quite along it everywhere
    assert area.mean() < 0.9


def test_a_zone_reads_one_side_where_the_other_is_pushed(zones, head):
    skin = head.rest.copy()
    left = skin[:, 0] > 0.0
    skin[left, 1] *= 0.9
    rows = zones.row_zone == 0
    values, side = measured(zones, skin)[0], zones.row_side[rows]
    assert values[side == 1.0].mean() < 0.93
    np.testing.assert_allclose(values[side == 0.0], 1.0, atol=5e-3)


def test_mirrored_skin_is_measured_mirrored(zones, head, fine_mirror):
    generator = np.random.default_rng(4)
    skin = head.rest + generator.normal(0.0, 0.3, head.rest.shape)
    mirrored = skin[head.mirror] * [-1.0, 1.0, 1.0]
    one, other = measured(zones, skin)[0], measured(zones, mirrored)[0]
    vertices = zones.row_vertex[zones.row_zone == 0]
    by_vertex = np.full(len(fine_mirror), np.nan)
    by_vertex[vertices] = other
    np.testing.assert_allclose(one, by_vertex[fine_mirror[vertices]], atol=1e-9)
