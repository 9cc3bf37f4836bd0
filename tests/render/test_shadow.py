import numpy as np
import pytest

from risorius.render.shadow import ShadowMap, light_matrix, lit, transform

DOWN = np.array([0.0, 1.0, 0.0])  # the lamp stands straight above


def square(half, height):
    points = [(-half, height, -half), (-half, height, half), (half, height, half), (half, height, -half)]
    return np.array(points, np.float32), np.array([[0, 1, 2], [0, 2, 3]], np.int32)


@pytest.fixture(scope="module")
def scene():
    """A floor of 160 mm, and 40 mm above it a square of 40 mm."""
    floor, faces = square(80, 0)
    roof, _ = square(20, 40)
    shadow = ShadowMap(DOWN, np.zeros(3), 100.0, 8, 4)
    shadow.update(np.concatenate([floor, roof]), np.concatenate([faces, faces + 4]), np.ones(4, np.uint8))
    return shadow


def share(shadow, x, y, z):
    place = tuple(np.float32(v) for v in (x, y, z))
    return lit(shadow.depth, shadow.low, shadow.high, shadow.matrix, place, np.float32(shadow.bias))


def test_the_matrix_covers_its_sphere():
    direction = np.array([0.4, 0.5, 0.7])
    matrix = light_matrix(direction, np.array([3.0, 4.0, 5.0]), 50.0, 100)
    x, y, depth = transform(matrix, (np.float32(3), np.float32(4), np.float32(5)))
    assert (x, y, depth) == pytest.approx((50, 50, 51), abs=1e-3)


def test_dark_under_the_roof_and_lit_beside_it(scene):
    assert share(scene, 0, 0, 0) == 0
    assert share(scene, 60, 0, 0) == 1
    assert share(scene, 0, 40, 0) == 1


def test_the_edge_is_soft_and_monotone(scene):
    across = [share(scene, x, 0, 0) for x in np.linspace(15, 25, 60)]
    assert (np.diff(across) >= -1e-6).all()
    assert sum(0.02 < s < 0.98 for s in across) > 8


def test_a_surface_does_not_shade_itself(scene):
    shares = [share(scene, x, 0, z) for x in np.linspace(-70, -30, 23) for z in np.linspace(-60, 60, 31)]
    assert min(shares) == 1


def test_outside_the_map_all_is_lit(scene):
    assert share(scene, 500, 0, 0) == 1


def test_bounds_are_those_of_the_taps(scene):
    for j, i in ((0, 0), (120, 151), (150, 190), (378, 378)):
        taps = scene.depth[j : j + 6, i : i + 6]
        assert (scene.low[j, i], scene.high[j, i]) == (taps.min(), taps.max())
