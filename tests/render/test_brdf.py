import numpy as np
import pytest

from risorius.render.brdf import gloss, mirrored, mirrored_change, schlick

UP = (np.float32(0), np.float32(0), np.float32(1))


def towards(degrees):
    a = np.radians(degrees)
    return np.float32(np.sin(a)), np.float32(0), np.float32(np.cos(a))


def textbook(normal, view, light, alpha, facing):
    """GGX (Walter et al. 2007) with Kelemen's visibility term, each formula as it is written."""
    normal, view, light = (np.array(v, np.float64) for v in (normal, view, light))
    half = (view + light) / np.linalg.norm(view + light)
    nh, lh = normal @ half, light @ half
    density = alpha**2 / (np.pi * (nh**2 * (alpha**2 - 1) + 1) ** 2)
    fresnel = facing + (1 - facing) * (1 - lh) ** 5
    return (normal @ light) * density * fresnel / (4 * lh**2)


@pytest.mark.parametrize("alpha", [0.05, 0.2, 0.6])
@pytest.mark.parametrize(("view", "light"), [(0, 0), (-30, 25), (50, 62), (-70, -55), (10, 85)])
def test_gloss_is_ggx_with_kelemens_term(alpha, view, light):
    given = (UP, towards(view), towards(light), np.float32(alpha), np.float32(0.028))
    assert gloss(*given) == pytest.approx(textbook(*given), rel=2e-4)


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


@pytest.mark.parametrize("alpha", [0.14, 0.3])
@pytest.mark.parametrize(("view", "light"), [(0, 20), (-30, 25), (20, 62)])
def test_the_change_of_the_gloss_is_its_derivative(alpha, view, light):
    half = np.add(towards(view), towards(light))
    terms = np.array([np.dot(UP, towards(light)), np.dot(UP, half)], np.float64)
    rest = float(half @ half), alpha, 0.028
    for which, found in enumerate(mirrored_change(*terms, *rest)):
        step = np.eye(2)[which] * 1e-5
        expected = (mirrored(*(terms + step), *rest) - mirrored(*(terms - step), *rest)) / 2e-5
        assert found == pytest.approx(expected, rel=1e-3)


def test_the_gloss_of_a_lamp_below_the_horizon_does_not_change():
    assert mirrored_change(-0.1, 0.5, 1.0, 0.2, 0.03) == (0, 0)
