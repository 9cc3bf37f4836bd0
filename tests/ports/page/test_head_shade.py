"""The light that the page draws a head in."""

import numpy as np
import pytest

from risorius.face.head.head import load_head
from risorius.ports.page.head_shade import light, shade


@pytest.fixture(scope="module")
def seen():
    head = load_head("standard")
    lamps = len(light().lamps)
    data = np.frombuffer(shade(head), np.uint8)
    return head, data.reshape(head.skin.matrix.shape[0], -1)[:, : 1 + lamps + 1]


def test_surroundings_and_each_lamp_are_kept_from_some_of_the_skin_and_not_from_all(seen):
    _, found = seen
    for column in found[:, :-1].T:
        assert column.min() < 60
        assert column.max() > 240


def test_a_lamp_at_one_side_is_seen_from_that_side(seen):
    """But for the first one, whose shadow moves with the face: the page draws it."""
    head, found = seen
    across = (head.skin.matrix @ head.rest)[:, 0]
    for lamp, column in zip(light().lamps[1:], found[:, 2:-1].T, strict=True):
        side = np.sign(lamp.direction[0])
        near, far = (column[across * side * way > 40.0].mean() for way in (1.0, -1.0))
        assert near > far or abs(lamp.direction[0]) < 0.3


def test_cloth_begins_below_the_neck(seen):
    head, found = seen
    height = (head.skin.matrix @ head.rest)[:, 1]
    hem = found[:, -1].astype(int)
    assert hem[np.argmax(height)] < 128 < hem[np.argmin(height)]
