import numpy as np
import pytest

from risorius.face.roots import inverse_cube_root


@pytest.mark.parametrize("x", [1.0, 1.0 + 1e-12, 1.5, 2.0, 7.9, 8.1, 1e3, 1e9, 1e30, 1e90])
def test_it_is_the_librarys_root_to_thirteen_digits(x):
    assert inverse_cube_root(x) * np.cbrt(x) == pytest.approx(1.0, abs=1e-13)
