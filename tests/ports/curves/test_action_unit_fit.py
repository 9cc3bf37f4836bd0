import numpy as np
import pytest

from risorius.core.action_units import resolve_targets
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.ports.curves.action_unit_fit import ActionUnitFit

NUMBERS = (1, 2, 4, 5, 6, 7, 9, 10, 12, 15, 17, 20, 26, 45)


@pytest.mark.parametrize("number", [n for n in NUMBERS if n not in (7, 45)])
def test_a_unit_alone_is_found_again(number: int) -> None:
    values = np.array([NEUTRAL])
    for name, value in resolve_targets({f"AU{number}": 0.6}).items():
        values[0, INDEX[name]] = value
    found = ActionUnitFit(NUMBERS).intensities(values)[0]
    assert found[NUMBERS.index(number)] == pytest.approx(0.6, abs=0.05)
    assert np.delete(found, NUMBERS.index(number)).max() < 0.05


def test_closed_eyes_are_a_blink() -> None:
    values = np.array([NEUTRAL])
    for name, value in resolve_targets({"AU45": 1.0}).items():
        values[0, INDEX[name]] = value
    assert ActionUnitFit(NUMBERS).intensities(values)[0, NUMBERS.index(45)] > 0.9


def test_a_face_at_rest_has_none() -> None:
    assert not ActionUnitFit(NUMBERS).intensities(np.array([NEUTRAL, NEUTRAL])).any()
