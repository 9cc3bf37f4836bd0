import numpy as np
import pytest

from risorius.render.occlusion import Occluder, ambient_occlusion, bake, lamp_reach, sky_directions

CENTRE = np.zeros(3)


def trench():
    """A floor with two walls of 30 mm at x = ±10; the floor's middle and a free spot of floor come first."""
    floor = [(0, 0, 0), (70, 0, 0), (-90, 0, -90), (-90, 0, 90), (90, 0, 90), (90, 0, -90)]
    walls = [(x, y, z) for x in (-10, 10) for y, z in ((0, -90), (30, -90), (30, 90), (0, 90))]
    triangles = [[2, 3, 4], [2, 4, 5]] + [
        [6 + k, 6 + k + a, 6 + k + b] for k in (0, 4) for a, b in ((1, 2), (2, 3))
    ]
    points = np.array(floor + walls, np.float32)
    normals = np.tile(np.array([0, 1, 0], np.float32), (len(points), 1))
    return Occluder(points, normals, np.array(triangles, np.int32), np.ones(len(triangles), np.uint8))


def test_directions_are_units_spread_evenly():
    directions = sky_directions(100)
    assert np.linalg.norm(directions, axis=1) == pytest.approx(np.ones(100))
    assert np.abs(directions.mean(axis=0)).max() < 0.02


def test_a_trench_sees_less_than_open_ground():
    free = ambient_occlusion(trench(), CENTRE, 130.0)
    # Between endless walls of height h at distance w the share is sin(atan(w / h)) = 0.32.
    assert free[0] == pytest.approx(0.32, abs=0.08)
    assert free[1] > 0.85


def test_a_lamp_behind_a_wall_does_not_reach():
    low = np.array([0.9, 0.436, 0.0])
    reach = lamp_reach(trench(), CENTRE, 130.0, low)
    assert reach[0] == 0
    assert reach[1] == 1


def test_the_first_lamp_is_not_baked(tmp_path, monkeypatch):
    monkeypatch.setenv("RISORIUS_CACHE_DIR", str(tmp_path))
    lamps = np.array([[0.0, 1.0, 0.0, 1, 1, 1, 0], [0.9, 0.436, 0.0, 1, 1, 1, 0]], np.float32)
    for again in range(2):
        free, reach = bake(trench(), CENTRE, 130.0, lamps)
        assert reach.shape == (len(free), 1)
        assert reach[:2, 0].tolist() == [0, 1], again
    assert bake(trench(), CENTRE, 130.0, lamps[:1])[1].shape == (len(free), 0)
