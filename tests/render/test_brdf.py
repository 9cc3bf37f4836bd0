import numpy as np
import pytest

from risorius.render.brdf import ggx, gloss, schlick

UP = (np.float32(0), np.float32(0), np.float32(1))


def towards(degrees):
    a = np.radians(degrees)
    return np.float32(np.sin(a)), np.float32(0), np.float32(np.cos(a))


@pytest.mark.parametrize("alpha", [0.05, 0.2, 0.6])
def test_microfacets_cover_the_surface_once(alpha):
    angle = np.linspace(0, np.pi / 2, 4001)
    density = np.array([ggx(np.float32(c), np.float32(alpha)) for c in np.cos(angle)])
    covered = np.trapezoid(2 * np.pi * density * np.cos(angle) * np.sin(angle), angle)
    assert covered == pytest.approx(1, abs=0.02)


def test_head_on_and_grazing_reflection():
    assert schlick(np.float32(1), np.float32(0.028)) == pytest.approx(0.028)
    assert schlick(np.float32(0), np.float32(0.028)) == pytest.approx(1)


def test_a_lamp_below_the_horizon_gives_no_gloss():
    assert gloss(UP, towards(0), towards(100), np.float32(0.2), np.float32(0.03)) == 0


def test_gloss_is_brightest_where_the_mirror_image_is():
    strength = [
        gloss(UP, towards(-30), towards(a), np.float32(0.1), np.float32(0.03)) for a in range(0, 61, 5)
    ]
    assert int(np.argmax(strength)) == 6
