from __future__ import annotations

import numpy as np
import pytest

from risorius.face.contact.contact import Contacts, Facing, find_contacts, narrowest

NX, NZ = 9, 5


def sheets(height, tilt=0.0):
    """A flat upper sheet at y = `height` + `tilt`·x over a lower one at y = 0, with their facing."""
    x, z = np.meshgrid(np.linspace(-4.0, 4.0, NX), np.linspace(0.0, 4.0, NZ))
    lower = np.column_stack([x.ravel(), np.zeros(x.size), z.ravel()])
    upper = lower + np.array([0.13, height, 0.07])
    upper[:, 1] += tilt * upper[:, 0]
    index = np.arange(NX * NZ).reshape(NZ, NX)
    quads = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    faces = np.vstack([quads[:, :3], quads[:, [0, 2, 3]]]).astype(np.int32)
    count = NX * NZ
    above = np.r_[np.ones(count, bool), np.zeros(count, bool)]
    facing = Facing(np.arange(2 * count, dtype=np.int32), above, faces, faces + np.int32(count))
    return np.vstack([upper, lower]), facing


@pytest.mark.parametrize("height", [1.5, 0.0, -0.4])
def test_gap_is_the_height_between_the_sheets_negative_where_they_overlap(height):
    points, facing = sheets(height)
    found = Contacts.allocate(len(points))
    count = find_contacts(facing, points, np.inf, found)
    assert count > NX * NZ
    np.testing.assert_allclose(found.gap[:count], height, atol=1e-12)


def test_weights_give_the_gap_and_how_it_opens():
    points, facing = sheets(0.7, tilt=0.1)
    found = Contacts.allocate(len(points))
    count = find_contacts(facing, points, np.inf, found)
    again = (found.weight[:count] * points[found.points[:count], 1]).sum(axis=1)
    np.testing.assert_allclose(again, found.gap[:count], atol=1e-12)
    np.testing.assert_allclose(found.weight[:count].sum(axis=1), 0.0, atol=1e-12)


def test_only_gaps_below_the_reach_are_found():
    points, facing = sheets(0.5, tilt=0.1)
    found = Contacts.allocate(len(points))
    count = find_contacts(facing, points, 0.4, found)
    assert 0 < count < len(points)
    assert found.gap[:count].max() < 0.4


def test_vertices_beside_the_other_sheet_touch_nothing():
    points, facing = sheets(1.0)
    points[: NX * NZ, 0] += 100.0
    assert find_contacts(facing, points, np.inf, Contacts.allocate(len(points))) == 0


def test_the_narrowest_contact_about_each_place():
    x = np.array([-2.0, -1.9, 0.0, 0.1, 2.0])
    gap = np.array([0.5, 0.3, 0.2, 0.4, 0.9])
    for start, width, count, wanted in (
        (-2.0, 0.5, 5, [1, 2, 2, 2, 4]),
        (2.0, 0.5, 5, [4, 2, 2, 2, 1]),
        (-2.0, 0.1, 2, [1, -1, -1, -1, -1]),
    ):
        nearest = np.zeros(5, np.int32)
        narrowest(start, -start, width, x, gap, count, nearest)
        assert nearest.tolist() == wanted
