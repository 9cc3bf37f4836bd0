import numpy as np
import pytest

from risorius.render.anatomy import smoothstep
from risorius.render.curvature import mean_curvature
from risorius.render.garment import neckline, standing_off


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


def test_curvature_of_a_sphere_is_one_over_its_radius():
    angle = np.linspace(0.3, np.pi - 0.3, 20), np.linspace(0, 2 * np.pi, 41)[:-1]
    polar, around = np.meshgrid(*angle, indexing="ij")
    normals = np.stack([np.sin(polar) * np.cos(around), np.cos(polar), np.sin(polar) * np.sin(around)], -1)
    index = np.arange(800).reshape(20, 40)
    right = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], right[:-1], right[1:], index[1:]], axis=-1).reshape(-1, 4)
    flat = normals.reshape(-1, 3)
    assert mean_curvature(25 * flat, flat, quads) == pytest.approx(np.full(800, 0.04), rel=0.01)


def test_the_neck_is_bare_and_the_shoulders_are_covered(anatomy):
    depth = neckline(anatomy)
    throat = (anatomy.skin[:, 1] > anatomy.chin - 20) & (anatomy.skin[:, 2] > -90)
    assert (depth[throat] < 0).all()
    assert (depth[np.abs(anatomy.skin[:, 0]) > 120] > 0).all()


def test_cloth_stands_off_the_skin_and_bare_skin_stays(anatomy, surface):
    depth = neckline(anatomy)
    offset = np.linalg.norm(standing_off(depth, surface.normals), axis=1)
    assert offset[depth < -2].max() == 0
    assert offset[depth > 4].min() > 1
