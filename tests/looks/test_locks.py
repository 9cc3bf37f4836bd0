import numpy as np

from risorius.looks.locks import respaced


def bent(rng):
    """Curves (5, 30, 3) that run straight, turn about a corner and run straight on."""
    way = np.linspace(0.0, 60.0, 30)
    corner = rng.uniform(15.0, 40.0, (5, 1))
    return np.stack([np.minimum(way, corner), np.maximum(way - corner, 0.0), np.zeros((5, 30))], axis=2)


def test_ends_stay_and_ways_rise():
    curves = bent(np.random.default_rng(1))
    points, way = respaced(curves, 9)
    np.testing.assert_allclose(points[:, [0, -1]], curves[:, [0, -1]], atol=1e-6)
    np.testing.assert_allclose(way[:, [0, -1]], [[0.0, 1.0]] * 5, atol=1e-12)
    assert (np.diff(way, axis=1) > 0).all()


def test_points_stand_close_where_a_curve_bends():
    curves = bent(np.random.default_rng(2))
    points, _ = respaced(curves, 9)
    corner = curves.max(axis=1)[:, None, :2] * [1.0, 0.0]
    shortest = np.linalg.norm(np.diff(points, axis=1), axis=2)
    nearest = np.linalg.norm(points[..., :2] - corner, axis=2).argmin(axis=1)
    for row, at in enumerate(nearest):
        assert shortest[row, at - 1 : at + 1].min() < 0.5 * shortest[row].max()


def test_a_straight_curve_keeps_even_steps():
    line = np.linspace(0.0, 1.0, 30)[None, :, None] * np.array([[[3.0, -40.0, 2.0]]])
    points, way = respaced(line, 7)
    np.testing.assert_allclose(way, [np.linspace(0.0, 1.0, 7)], atol=1e-3)
    np.testing.assert_allclose(points, way[..., None] * line[:, -1:], atol=1e-6)
