from __future__ import annotations

import numpy as np
import pytest

from risorius.face.muscles.jaw import Jaw


@pytest.fixture(scope="module")
def jaw(head):
    return Jaw.of(head)


def carried(jaw, head, opening, displacement=None):
    out = np.full_like(head.rest, np.nan)
    still = np.zeros_like(head.rest) if displacement is None else displacement
    jaw.carry_skin(head.rest, still, opening, out)
    return out


def test_a_closed_jaw_moves_nothing(jaw, head):
    np.testing.assert_array_equal(carried(jaw, head, 0.0), head.rest)
    np.testing.assert_allclose(
        jaw.carry(head.teeth_lower.vertices, 0.0), head.teeth_lower.vertices, atol=1e-12
    )


@pytest.mark.parametrize("opening", [0.3, 1.0])
def test_teeth_turn_rigidly_about_the_hinge(jaw, head, opening):
    before, after = head.teeth_lower.vertices, jaw.carry(head.teeth_lower.vertices, opening)
    np.testing.assert_allclose(
        np.linalg.norm(after - after[::-1], axis=1), np.linalg.norm(before - before[::-1], axis=1), atol=1e-9
    )
    np.testing.assert_allclose(
        np.linalg.norm(np.cross(after - jaw.point, jaw.axis), axis=1),
        np.linalg.norm(np.cross(before - jaw.point, jaw.axis), axis=1),
        atol=1e-9,
    )
    assert after[:, 1].mean() < before[:, 1].mean() - 5.0 * opening


def test_skin_without_weight_stays_and_fully_weighted_skin_goes_with_the_teeth(jaw, head):
    moved = carried(jaw, head, 0.5) - 0.5 * jaw.corrective
    np.testing.assert_array_equal(moved[head.jaw_weight == 0.0], head.rest[head.jaw_weight == 0.0])
    full = head.jaw_weight == 1.0
    assert full.any()
    np.testing.assert_allclose(moved[full], jaw.carry(head.rest[full], 0.5), atol=1e-9)


def test_the_corrective_is_added_after_the_rotation(jaw, head):
    bare = Jaw(jaw.point, jaw.axis, jaw.angle, jaw.weight, np.zeros_like(jaw.corrective))
    difference = carried(jaw, head, 0.6) - carried(bare, head, 0.6)
    np.testing.assert_allclose(difference, 0.6 * jaw.corrective, atol=1e-12)


def test_displacements_turn_with_the_jaw(jaw, head):
    raised = np.tile([0.0, 2.0, 0.0], (len(head.rest), 1))
    difference = carried(jaw, head, 1.0, raised) - carried(jaw, head, 1.0)
    np.testing.assert_allclose(np.linalg.norm(difference, axis=1), 2.0, atol=1e-9)
    chin = head.jaw_weight == 1.0
    np.testing.assert_allclose(difference[chin, 1], 2.0 * np.cos(jaw.angle), atol=1e-9)
