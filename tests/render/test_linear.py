import numpy as np
import pytest

from risorius.render.linear_block import COLUMNS, GROUP, MEANS, mean_at
from risorius.render.software_renderer import SoftwareRenderer


def test_means_are_those_of_the_planes_at_the_samples():
    rng = np.random.default_rng(0)
    planes = rng.normal(size=(9, COLUMNS)).astype(np.float32)
    rows, x, y = np.array([3, 0, 8, 3]), np.float32(4.5), np.float32(10.5)
    out = np.zeros(MEANS, np.float32)
    mean_at(planes, tuple(rows), x, y, out)
    start, right, down, same = np.split(planes[rows].astype(float), range(GROUP, COLUMNS, GROUP), axis=1)
    across, below = np.array([[x, x + 1, x, x + 1], [y, y, y + 1, y + 1]])[:, :, None]
    expected = np.concatenate([start + across * right + below * down, same], axis=1).mean(axis=0)
    assert out == pytest.approx(expected[:MEANS], abs=1e-5)


@pytest.fixture(scope="module")
def pictures(model, face):
    """A face, drawn with linear triangles and by shading all its pixels."""
    frame = face(masseter=0.3, AU12=0.7, AU04=0.6, head_yaw=15.0)
    linear, full = (SoftwareRenderer(model, (480, 480)) for _ in range(2))
    full.is_linear = False
    return linear.render(frame).astype(int), full.render(frame).astype(int)


def test_nobody_can_tell_linear_triangles_from_shaded_pixels(pictures):
    linear, full = pictures
    apart = np.abs(linear - full)
    assert 0 < np.sqrt((apart**2).mean()) < 0.8
    assert (apart.max(axis=2) > 12).mean() < 5e-4
    assert abs((linear - full).mean()) < 0.02


def test_a_picture_is_the_same_whatever_was_drawn_before(model, face):
    fresh, used = (SoftwareRenderer(model, (160, 160)) for _ in range(2))
    used.render(face(masseter=0.9, head_yaw=-30.0))
    frame = face(AU12=0.5, head_yaw=15.0)
    assert np.array_equal(used.render(frame), fresh.render(frame))
