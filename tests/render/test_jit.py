import pytest

from risorius.render.jit import BANDS, band_rows


@pytest.mark.parametrize("height", [16, 31, 32, 720, 1441])
def test_bands_cover_every_row_once(height):
    rows = sorted(row for turn in range(BANDS) for row in range(*band_rows(turn, height)))
    assert rows == list(range(height))
