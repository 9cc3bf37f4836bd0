import numpy as np
import pytest

from risorius.render.eyeball import cap, iris_image, lid_margins
from risorius.render.materials.eye import LID_STEPS


def test_the_cap_is_a_sphere_wound_outwards():
    vertices, triangles = cap()
    assert np.linalg.norm(vertices, axis=1) == pytest.approx(np.ones(len(vertices)))
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    assert ((np.cross(b - a, c - a) * (a + b + c)).sum(axis=1) > 0).all()


def test_the_iris_is_dark_at_its_limbus_and_has_fibres():
    image = iris_image((132, 112, 74), (74, 94, 104))
    assert np.isfinite(image).all()
    assert image.min() >= 0
    assert image[-1].mean() < 0.5 * image[len(image) // 2].mean()
    assert image[len(image) // 2].std() > 0.05 * image[len(image) // 2].mean()


def test_the_iris_closes_around_the_pupil():
    image = iris_image((132, 112, 74), (74, 94, 104))
    steps = np.abs(np.diff(image, axis=1)).max()
    assert np.abs(image[:, 0] - image[:, -1]).max() <= 1.5 * steps


def test_lid_margins_are_heights_over_the_eye():
    x = np.linspace(-10, 10, 9)
    upper = np.stack([x, np.full(9, 4.0), np.full(9, 11.0)], axis=1)
    lower = np.stack([x, np.full(9, -5.0), np.full(9, 11.0)], axis=1)
    centre = np.array([29.0, 0.0, 0.0])
    span, heights = lid_margins(np.stack([upper, lower], axis=1) + centre, centre, 12.0)
    assert heights.shape == (LID_STEPS, 2)
    assert span[0] == pytest.approx(-span[1])
    assert (heights[:, 0] > 3).all()
    assert (heights[:, 1] < -3.5).all()
    assert heights == pytest.approx(heights[::-1], abs=1e-9)
