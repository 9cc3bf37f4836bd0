import numpy as np
import pytest

from risorius.core.look import FRAMINGS
from risorius.render.framing import frame_head


def placed(camera, point, width, height):
    """Return where a point (3,) appears, in shares of the picture from its left and top."""
    x, y, d = camera.matrix(width, height) @ np.append(point, 1.0)
    return x / d / width, y / d / height


@pytest.mark.parametrize("name", FRAMINGS)
@pytest.mark.parametrize("size", [(720, 720), (1920, 1080), (540, 960)])
def test_what_a_framing_shows_lies_in_the_picture(anatomy, name, size):
    camera = frame_head(anatomy, size[0] / size[1], name)
    shown = {
        "mouth": [anatomy.mouth],
        "eyes": [np.array([side * 40.0, anatomy.eye_height, 10.0]) for side in (-1, 1)],
    }.get(
        name, [anatomy.mouth, np.array([0.0, anatomy.chin, 10.0]), np.array([0.0, anatomy.eye_height, 25.0])]
    )
    for point in shown:
        assert all(0.03 < place < 0.97 for place in placed(camera, point, *size))


def test_the_profile_is_seen_from_the_side(anatomy):
    right, _, backward = frame_head(anatomy, 1.0, "profile").axes()
    assert abs(backward[0]) == pytest.approx(1.0)
    assert abs(right[2]) == pytest.approx(1.0)


def test_a_longer_lens_stands_further_off_and_shows_the_same(anatomy):
    near, far = (frame_head(anatomy, 1.0, "portrait", lens) for lens in (50.0, 135.0))
    assert far.eye[2] > 2.5 * near.eye[2]
    assert far.millimetres_per_sample(720) == pytest.approx(near.millimetres_per_sample(720))


def test_the_angle_of_a_lens_is_that_of_the_short_side(anatomy):
    assert frame_head(anatomy, 1.0).field_of_view == pytest.approx(16.1, abs=0.1)
    upright = frame_head(anatomy, 0.5)
    assert np.tan(np.radians(upright.field_of_view / 2)) * 0.5 == pytest.approx(12 / 85)
