import numpy as np
import pytest

from risorius.errors import InputError
from risorius.render.backdrop import gradient
from risorius.render.lights import STUDIO, Lamp, LightRig


def test_a_rig_without_lamps_is_an_error():
    with pytest.raises(InputError, match="a light rig without lamps; expected at least one"):
        LightRig((), (1, 1, 1), (1, 1, 1))


def test_directions_of_lamps():
    assert Lamp(0, 0, (1, 1, 1)).direction() == pytest.approx((0, 0, 1))
    assert Lamp(90, 0, (1, 1, 1)).direction() == pytest.approx((1, 0, 0), abs=1e-9)
    assert Lamp(0, 90, (1, 1, 1)).direction() == pytest.approx((0, 1, 0), abs=1e-9)


def test_a_rig_as_arrays():
    lighting = STUDIO.lighting()
    assert lighting.lamps.shape == (len(STUDIO.lamps), 7)
    assert np.linalg.norm(lighting.lamps[:, :3], axis=1) == pytest.approx(
        np.ones(len(STUDIO.lamps)), abs=1e-6
    )
    assert lighting.ambient[0] == pytest.approx(STUDIO.sky)


def test_the_backdrop_is_brighter_behind_the_head():
    picture = gradient(60, 40, STUDIO.centre, STUDIO.edge)
    assert picture.shape == (40, 60, 3)
    assert picture.min() >= 0
    assert picture.max() <= 1
    assert picture[18:22, 28:32].mean() > 1.5 * picture[:4, :4].mean()
    assert np.array_equal(picture, gradient(60, 40, STUDIO.centre, STUDIO.edge))


def test_a_rig_of_too_many_lamps_is_an_error():
    with pytest.raises(InputError, match="a light rig of 5 lamps; expected at most 4"):
        LightRig(lamps=(Lamp(0.0, 0.0, (1.0, 1.0, 1.0)),) * 5, sky=(0.0, 0.0, 0.0), ground=(0.0, 0.0, 0.0))
