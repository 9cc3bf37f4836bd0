import numpy as np
import pytest

from risorius.looks.eyeball import cap, iris_image, iris_picture, pupil_axes


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


def test_the_picture_of_an_eye_is_an_iris_within_white():
    picture = iris_picture((132, 112, 74), (74, 94, 104), 64)
    assert picture.shape == (64, 64, 3)
    assert picture[32, 32].max() < 40
    assert picture[0, 0].min() > 200
    assert 40 < picture[32, 32 + 8].mean() < 200


def test_pupils_stand_out_a_little_from_where_the_eyes_look():
    ahead = pupil_axes() @ [0.0, 0.0, 1.0]
    assert ahead[0] == pytest.approx(ahead[1] * [-1, 1, 1])
    assert 2.8 < np.degrees(np.arcsin(ahead[0, 0])) < 5.6
