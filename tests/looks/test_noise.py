import pytest

from risorius.looks.noise import noise_tile


def test_heights_have_mean_zero_and_variance_one():
    tile = noise_tile()
    assert tile.mean() == pytest.approx(0, abs=1e-3)
    assert tile.std() == pytest.approx(1, abs=1e-3)
    assert not tile.flags.writeable
