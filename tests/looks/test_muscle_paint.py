import numpy as np
import pytest

from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.head.head import load_head
from risorius.looks.muscle_paint import colours, place_muscles

ZYGOMATIC = "zygomatic_major.left"


@pytest.fixture(scope="module")
def laid(head):
    return place_muscles(head, len(head.skin.triangles) + 100)


def inside(laid, name):
    """Return which vertices lie within a muscle."""
    return laid.place[:, laid.columns.tolist().index(INDEX[name]), 0] > 0


def test_every_muscle_covers_some_skin_and_nothing_else(laid, head):
    skin = len(head.skin.triangles)
    bits = np.bitwise_or.reduce(laid.covered)
    assert bits == (1 << len(laid.columns)) - 1
    assert (laid.covered[skin:] == 0).all()
    assert (laid.place[:, :, 0] > 0).any(axis=0).all()


def test_muscles_lie_along_their_lines_of_pull(laid, anatomy, head):
    row, _ = head.muscles()["zygomatic_major"]
    points = anatomy.skin[inside(laid, ZYGOMATIC)]
    origin, insertion = (np.array(p) for p in row.line)
    along = (points - origin) @ (insertion - origin) / np.sum((insertion - origin) ** 2)
    assert along.min() > -0.15
    assert along.max() < 1.15
    assert along.max() - along.min() > 0.8
    assert np.ptp(laid.place[inside(laid, ZYGOMATIC), laid.columns.tolist().index(INDEX[ZYGOMATIC]), 1]) < 14


def test_left_and_right_are_mirrored(laid, anatomy):
    left = anatomy.skin[inside(laid, ZYGOMATIC)]
    right = anatomy.skin[inside(laid, "zygomatic_major.right")]
    assert (left[:, 0] > 0).all()
    assert left.mean(axis=0) * [-1, 1, 1] == pytest.approx(right.mean(axis=0), abs=0.5)


def test_a_head_of_the_same_mesh_has_them_at_the_same_vertices(laid):
    other = place_muscles(load_head("olaf"), len(laid.covered))
    assert np.array_equal(other.place, laid.place)


def test_activation_reddens_and_inhibition_glows(laid):
    column = laid.columns.tolist().index(INDEX[ZYGOMATIC])
    active, kept = np.array(NEUTRAL), np.zeros(len(NEUTRAL))
    rest = colours(laid, active, kept)[column]
    active[INDEX[ZYGOMATIC]] = 1.0
    red = colours(laid, active, kept)[column]
    assert red[0] / red[1] > 3 * rest[0] / rest[1]
    assert red[3] > rest[3] + 0.4
    kept[INDEX[ZYGOMATIC]] = 1.0
    hot = colours(laid, np.array(NEUTRAL), kept)[column]
    assert hot[0] > 1.0
    assert hot[1] > 10 * red[1]
