import numpy as np
import pytest

from risorius.looks.srgb import srgb_encode
from risorius.render.tone import WHITE, exposed, film, film_table, to_byte, tone_table


def test_film_rises_from_black_to_white():
    light = np.linspace(0, WHITE, 500)
    shown = film(light)
    assert shown[0] == 0
    assert (np.diff(shown) >= 0).all()
    assert film(np.array([WHITE, 100.0])) == pytest.approx([1.0, 1.0], abs=0.02)


@pytest.mark.parametrize("light", [-1.0, 0.0, 0.02, 0.3, 1.0, 3.0, 50.0])
def test_the_tables_agree_with_the_curves(light):
    shown = exposed(film_table(), np.float32(light))
    assert shown == pytest.approx(float(film(np.array(light))), abs=2e-3)
    assert abs(to_byte(tone_table(), np.float32(shown)) - 255 * float(srgb_encode(np.array(shown)))) < 1
