from __future__ import annotations

import numpy as np
import pytest

from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.contact.contact import Contacts, find_contacts
from risorius.face.contact.mouth import OVERLAP, STATIONS, Mouth, TeethEdge
from risorius.face.head.head import load_head, shipped_heads
from risorius.face.solve import FaceSolver
from tests.profiles import everyday


@pytest.fixture(scope="module")
def mouth(head):
    return Mouth.of(head)


def test_the_lips_do_not_overlap_at_rest(mouth, head):
    found = Contacts.allocate(len(mouth.facing.vertices))
    count = find_contacts(mouth.facing, mouth.matrix @ head.rest, np.inf, found)
    assert count > 100
    assert found.gap[:count].min() > -OVERLAP


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["standard"]))
def test_a_jaw_that_opens_brings_nothing_together_and_the_corners_do_not_jump(name):
    head = load_head(name)
    solver, values = FaceSolver(head), NEUTRAL.copy()
    lips = head.skin.matrix @ head.masks["lips"] > 0.5
    skins = []
    for opening in np.arange(0.02, 0.52, 0.02):
        values[INDEX["masseter"]] = opening
        skins.append(solver.solve(values).skin[lips].astype(np.float64))
    assert np.abs(np.diff(skins, 2, axis=0)).max() < 0.1


def test_the_line_runs_from_corner_to_corner_and_its_points_lie_together_at_rest(mouth, head):
    points = mouth.matrix @ head.rest
    upper, lower = np.maximum(mouth.line, 0.0) @ points, np.maximum(-mouth.line, 0.0) @ points
    assert len(mouth.line) == STATIONS
    assert (np.diff(upper[:, 0]) > 0.0).all()
    assert upper[-1, 0] == pytest.approx(np.abs(head.rest[head.lip_pairs]).mean(axis=1)[:, 0].max(), abs=2.5)
    np.testing.assert_allclose(upper[:, [0, 2]], lower[:, [0, 2]], atol=1e-6)
    assert np.abs(upper[:, 1] - lower[:, 1]).max() < 0.5


def test_the_lips_are_what_lies_above_and_below(mouth, rest):
    assert rest[mouth.lip(True), 1].mean() > rest[mouth.lip(False), 1].mean() + 1.0


def test_the_teeth_edge_lies_on_the_upper_teeth(head):
    edge = TeethEdge.of(head.teeth_upper, 14.0, 16)
    y, z = edge.at(np.array([0.0, 7.0, -7.0]))
    crowns = head.teeth_upper.vertices[head.teeth_upper.material < 0.5]
    for x, at_y, at_z in zip((0.0, 7.0, -7.0), y, z, strict=True):
        assert np.linalg.norm(crowns - [x, at_y, at_z], axis=1).min() < 1.5
    assert y.max() < head.teeth_upper.vertices[:, 1].mean()
    assert z[1] == pytest.approx(z[2], abs=0.1)
