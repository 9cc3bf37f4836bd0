import numpy as np
import pytest

from risorius.looks.anatomy import smoothstep


def test_marks_of_the_face_stand_in_their_order(anatomy):
    assert anatomy.top > anatomy.eye_height > anatomy.nose_tip[1] > anatomy.mouth[1] > anatomy.chin
    assert abs(anatomy.nose_tip[0]) < 3
    assert anatomy.nose_tip[2] == pytest.approx(anatomy.skin[np.abs(anatomy.skin[:, 0]) < 3, 2].max())
    assert 15 < anatomy.mouth_half_width < 35


def test_the_sphere_holds_the_head(anatomy):
    centre, radius = anatomy.sphere()
    head = anatomy.skin[anatomy.skin[:, 1] > anatomy.chin]
    assert np.linalg.norm(head - centre, axis=1).max() < radius


def test_masks_stay_between_0_and_1(anatomy):
    for mask in anatomy.masks.values():
        assert mask.min() >= 0
        assert mask.max() <= 1


def test_smoothstep_is_flat_at_its_ends():
    assert smoothstep(2, 4, np.array([1.0, 2.0, 3.0, 4.0, 9.0])).tolist() == [0, 0, 0.5, 1, 1]
