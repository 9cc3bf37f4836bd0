import numpy as np
import pytest

from risorius.looks.srgb import srgb_decode, srgb_encode
from risorius.render.cutout import covered, cut_out


def test_coverage_counts_samples():
    ids = np.full((4, 6), -1, np.int32)
    ids[:2, :2] = 0
    ids[0, 2] = 7
    assert covered(ids, 2) == pytest.approx(np.array([[1.0, 0.25, 0.0], [0.0, 0.0, 0.0]]))


def test_colours_are_freed_of_the_black_behind_them():
    share = np.array([[0.0, 0.25, 0.75, 1.0]], np.float32)
    colour = np.array([200, 120, 60])
    drawn = np.round(srgb_encode(srgb_decode(colour / 255) * share[..., None]) * 255).astype(np.uint8)
    out = np.empty((1, 4, 4), np.uint8)
    cut_out(drawn, share, out)
    assert out[0, :, 3].tolist() == [0, 64, 191, 255]
    assert np.abs(out[0, 1:, :3].astype(int) - colour).max() <= 3
