"""Head and gaze: attenuated sums."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius import blend
from risorius.blend.directions import combine_directions, shares_of
from risorius.core.movement import Movement
from risorius.core.parameters import INDEX
from risorius.core.score import Score


def combined(name: str, terms: list[np.ndarray]) -> np.ndarray:
    return combine_directions(name, shares_of(name, terms))


@pytest.mark.parametrize(
    ("name", "terms", "expected"),
    [
        ("head_yaw", [12.0], 12.0),
        ("head_yaw", [20.0, 10.0], 20 / 1.25 + 10 / 1.5),
        ("head_pitch", [10.0, -10.0], 0.0),
        ("gaze_yaw", [25.0, 25.0], 50 / 1.5),
        ("gaze_distance", [1.2], 2.0),
        ("head_roll", [60.0], 45.0),
        ("gaze_distance", [-0.79], 0.1),
    ],
)
def test_the_formula(name: str, terms: list[float], expected: float) -> None:
    assert combined(name, [np.array([x]) for x in terms]) == pytest.approx([expected])


@given(st.lists(st.floats(-40, 40), min_size=1, max_size=5))
def test_order_does_not_matter_and_signs_mirror(terms: list[float]) -> None:
    arrays = [np.array([x]) for x in terms]
    total = combined("head_yaw", arrays)
    assert combined("head_yaw", arrays[::-1]) == pytest.approx(total)
    assert combined("head_yaw", [-x for x in arrays]) == pytest.approx(-total)


def test_channels_and_layers_all_count() -> None:
    turn = Movement("head", 0.0, 2.0, 0.0, 0.0, {"head_yaw": 10.0})
    other_layer = Movement("head", 0.0, 2.0, 0.0, 0.0, {"head_yaw": 10.0}, layer="slow")
    emotion = Movement("emotion", 0.0, 2.0, 0.0, 0.0, {"head_yaw": 10.0})
    values = blend.at(Score(2.0, (turn, other_layer, emotion)), np.array([1.0]))
    assert values[0, INDEX["head_yaw"]] == pytest.approx(3 * 10 / 1.5)
