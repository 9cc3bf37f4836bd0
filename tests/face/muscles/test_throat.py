from __future__ import annotations

import numpy as np
import pytest

from risorius.face.head.head import load_head
from risorius.face.muscles.fold_prevention import struts
from risorius.face.muscles.jaw import Jaw
from risorius.face.muscles.throat import LEAST, resolve_throat_folds
from risorius.face.numerics.rotations import turned

STRIP = np.array([[0, 1, 3, 2], [2, 3, 5, 4]])
AXIS = np.array([1.0, 0.0, 0.0])


def strip():
    """Two faces 4 mm high, one above the other."""
    return np.array([[x, y, 0.0] for y in (-8.0, -4.0, 0.0) for x in (0.0, 5.0)])


def shortest(edges, rest, opened, angle):
    """The least share of an edge's length that is left along its turned direction."""
    before, now = (p[edges[:, 1]] - p[edges[:, 0]] for p in (rest, opened))
    length = np.linalg.norm(before, axis=1)
    way = turned(before / length[:, None], AXIS, angle[edges].mean(axis=1))
    return ((now * way).sum(axis=1) / length).min()


def test_skin_that_is_laid_over_itself_is_pushed_apart():
    rest, angle = strip(), np.zeros(6)
    opened = rest.copy()
    opened[4:, 1] = -5.0  # the upper edge, below the middle one
    resolve_throat_folds(STRIP, rest, 1.0, AXIS, angle, opened)
    assert shortest(struts(STRIP), rest, opened, angle) > LEAST - 0.02


def test_what_has_room_or_lies_higher_is_left_alone():
    rest, angle = strip(), np.full(6, 0.3)
    opened = turned(rest, AXIS, angle)
    kept = opened.copy()
    resolve_throat_folds(STRIP, rest, 1.0, AXIS, angle, opened)
    np.testing.assert_allclose(opened, kept, atol=1e-12)
    crushed = 0.1 * rest
    resolve_throat_folds(STRIP, rest, -10.0, AXIS, angle, crushed)
    np.testing.assert_array_equal(crushed, 0.1 * rest)


def test_a_head_at_its_own_age_keeps_its_jaw():
    for name in ("standard", "mei"):
        head = load_head(name)
        change = Jaw.of(head).corrective.copy()
        change[head.jaw_corrective.vertices] -= head.jaw_corrective.displacement
        assert np.abs(change).max() < 0.01


@pytest.mark.parametrize("age", [75, 90])
def test_an_old_throat_is_not_crushed(age):
    head = load_head("mei", age=age)
    jaw, opened = Jaw.of(head), np.empty_like(head.rest)
    jaw.carry_skin(head.rest, np.zeros_like(head.rest), 1.0, opened)
    edges = struts(head.quads)
    throat = head.rest[:, 1] < head.rest[head.masks["lips"] > 0.5, 1].min()
    edges = edges[throat[edges].all(axis=1)]
    assert shortest(edges, head.rest, opened, jaw.weight * jaw.angle) > LEAST - 0.05
