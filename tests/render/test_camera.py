import numpy as np
import pytest

from risorius.errors import InputError
from risorius.render.camera import Camera, portrait, project
from risorius.render.raster import SUBPIXEL


def seen(camera, points, width=200, height=100):
    points = np.asarray(points, np.float32)
    xy, key = np.zeros((len(points), 2), np.int32), np.zeros(len(points), np.float32)
    project(points, camera.matrix(width, height), xy, key)
    return xy / SUBPIXEL, key


@pytest.mark.parametrize(
    ("eye", "target", "angle", "message"),
    [
        ((0, 0, 500), (0, 0, 0), 0.5, "field of view 0.5; expected 1 to 120 degrees"),
        ((0, 0, 500), (0, 0, 0), 170, "field of view 170"),
        ((0, 0, 500), (0, 0, 500), 20, "stands on its target"),
        ((0, 500, 0), (0, 0, 0), 20, "straight up or down"),
    ],
)
def test_a_camera_that_cannot_be_is_an_error(eye, target, angle, message):
    with pytest.raises(InputError, match=message):
        Camera(eye, target, angle)


def test_a_frame_upside_down_is_an_error():
    with pytest.raises(InputError, match="top 10 lies below its bottom 20"):
        portrait(10.0, 20.0, (0.0, 0.0, 0.0))


def test_the_target_stands_in_the_middle_at_its_distance():
    xy, key = seen(Camera((30, 40, 700), (10, 20, 100)), [(10, 20, 100)])
    assert xy[0] == pytest.approx([100, 50], abs=0.02)
    assert 1 / key[0] == pytest.approx(np.sqrt(20**2 + 20**2 + 600**2), rel=1e-5)


def test_up_is_up_and_the_subjects_left_is_at_the_right():
    xy, _ = seen(Camera((0, 0, 500), (0, 0, 0)), [(0, 0, 0), (20, 0, 0), (0, 20, 0)])
    assert xy[1, 0] > xy[0, 0]
    assert xy[2, 1] < xy[0, 1]


def test_a_portrait_reaches_from_bottom_to_top():
    xy, _ = seen(portrait(120.0, -180.0, (5.0, 0.0, 10.0)), [(5, 120, 10), (5, -180, 10)])
    assert xy[:, 1] == pytest.approx([0, 100], abs=0.05)


def test_size_of_a_sample_at_the_target():
    camera = portrait(50.0, -50.0, (0.0, 0.0, 0.0))
    assert camera.millimetres_per_sample(200) == pytest.approx(0.5, rel=1e-6)


def test_what_stands_behind_the_camera_stays_within_bounds():
    xy, key = seen(Camera((0, 0, 500), (0, 0, 0)), [(300, 0, 900), (1e6, -1e6, 499.9)])
    assert np.isfinite(key).all()
    assert (np.abs(xy) <= (1 << 22) / SUBPIXEL).all()
