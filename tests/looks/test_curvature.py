import numpy as np
import pytest

from risorius.looks.curvature import mean_curvature


def test_curvature_of_a_sphere_is_one_over_its_radius():
    angle = np.linspace(0.3, np.pi - 0.3, 20), np.linspace(0, 2 * np.pi, 41)[:-1]
    polar, around = np.meshgrid(*angle, indexing="ij")
    normals = np.stack([np.sin(polar) * np.cos(around), np.cos(polar), np.sin(polar) * np.sin(around)], -1)
    index = np.arange(800).reshape(20, 40)
    right = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], right[:-1], right[1:], index[1:]], axis=-1).reshape(-1, 4)
    flat = normals.reshape(-1, 3)
    assert mean_curvature(25 * flat, flat, quads) == pytest.approx(np.full(800, 0.04), rel=0.01)
