"""How far a seal closes the lips, by the rig of a head."""

import numpy as np
import pytest

from risorius.core.lips.closed_lips import closed_lips, shut_lips
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.fit.lip_file import load_lip_rig


def lips(jaw: float, seal: float) -> tuple[float, float]:
    values = np.array([NEUTRAL])
    values[0, INDEX["masseter"]], values[0, INDEX["lip_seal"]] = jaw, seal
    rig = load_lip_rig()
    return float(closed_lips(rig, values)[0]), float(shut_lips(rig, values)[0])


@pytest.mark.parametrize(
    ("jaw", "seal", "closed", "shut"),
    [
        (0.0, 0.0, 0.0, 0.0),  # at rest lips touch, but nothing closes them
        (0.2, 0.0, 0.0, 0.0),
        (0.2, 1.0, 1.0, 1.0),
        (0.05, 0.4, 1.0, 1.0),  # a small gap needs a small seal
        (0.6, 0.1, 0.0, 0.1),  # a seal that does not reach
    ],
)
def test_lips_are_closed_where_a_seal_reaches(jaw: float, seal: float, closed: float, shut: float) -> None:
    assert lips(jaw, seal) == pytest.approx((closed, shut))


def test_they_close_without_a_jump() -> None:
    found = np.array([lips(0.2, seal) for seal in np.linspace(0.0, 1.0, 201)])
    assert np.abs(np.diff(found, axis=0)).max() < 0.12
    assert (np.diff(found, axis=0) > -1e-9).all()
