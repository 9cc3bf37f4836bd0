import numpy as np
import pytest

from risorius.core.functions import ONSET_FUNCTIONS
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
