import pytest

from risorius.render import raster
from risorius.render.jit import _SOURCES, BANDS, band_rows


@pytest.mark.parametrize("height", [16, 31, 32, 720, 1441])
def test_bands_cover_every_row_once(height):
    rows = sorted(row for turn in range(BANDS) for row in range(*band_rows(turn, height)))
    assert rows == list(range(height))


def test_kept_code_depends_on_all_sources():
    assert raster.find_rows._cache._cache_file._source_stamp[1] == _SOURCES
    assert len(_SOURCES) > 20
