import numpy as np
import pytest

from risorius.core.functions import ONSET_FUNCTIONS, positive_part
from risorius.errors import ParameterError


def test_unknown_function_is_reported() -> None:
    with pytest.raises(ParameterError, match="did you mean 'exponential'"):
        ONSET_FUNCTIONS.get("exponental")


@pytest.mark.parametrize("name", ONSET_FUNCTIONS.names())
def test_functions_rise_monotonously_from_0_to_1(name: str) -> None:
    y = ONSET_FUNCTIONS.get(name)(np.linspace(0.0, 1.0, 1001))
    assert y[0] == 0.0
    assert y[-1] == pytest.approx(1.0, abs=1e-15)
    assert (np.diff(y) > 0).all()


def test_paper_a_has_its_half_value() -> None:
    # phi_+(D/2, D) = sqrt(2) - 1
    assert ONSET_FUNCTIONS.get("exponential")(np.array([0.5]))[0] == pytest.approx(2**0.5 - 1)


class TestPositivePart:
    def test_it_is_the_value_from_the_width_on_and_0_below_0(self) -> None:
        x = np.array([-1.0, 0.0, 0.3, 5.0])
        assert positive_part(x, 0.3).tolist() == [0.0, 0.0, 0.3, 5.0]

    def test_it_rises_without_a_corner(self) -> None:
        x = np.linspace(-0.2, 0.6, 8001)
        slope = np.diff(positive_part(x, 0.3)) / np.diff(x)
        assert slope.min() >= 0.0
        assert np.abs(np.diff(slope)).max() < 0.03

    def test_what_dies_away_comes_to_rest(self) -> None:
        assert positive_part(np.array([1e-5]), 0.3)[0] == 0.0
