"""Head and gaze: attenuated sums."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius import blend
from risorius.blend.directions import RANGE, combine_directions, shares_of
from risorius.core.movement import ManualCurve, Movement
from risorius.core.parameters import INDEX, PARAMETERS
from risorius.core.score import BlendSettings, Score


def combined(name: str, terms: list[np.ndarray]) -> np.ndarray:
    shares = shares_of(PARAMETERS[INDEX[name]].kind, [{name: term} for term in terms])
    return combine_directions(name, [share[name] for share in shares])


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


def turned(targets: dict[str, float], layer: str, channel: str = "head") -> Movement:
    return Movement(channel, 0.0, 2.0, 0.0, 0.0, targets, layer=layer)


def at_one_second(
    *movements: Movement, conflict: str = "graded", manual: tuple[ManualCurve, ...] = ()
) -> dict[str, float]:
    settings = BlendSettings(conflict=conflict)
    values = blend.at(Score(2.0, movements, settings=settings, manual=manual), np.array([1.0]))[0]
    return {name: values[index] for name, index in INDEX.items()}


@pytest.mark.parametrize("conflict", ["graded", "inhibit", "attenuate", "sum"])
@pytest.mark.parametrize("channels", [("head", "head"), ("head", "emotion"), ("regulators", "signals")])
@pytest.mark.parametrize(
    ("turn", "nod"),
    [
        (("head_yaw", 10.0), ("head_pitch", -6.0)),
        (("head_roll", -12.0), ("head_yaw", 5.0)),
        (("gaze_yaw", 18.0), ("gaze_pitch", -9.0)),
    ],
)
def test_turning_while_nodding_makes_both_smaller(
    conflict: str, channels: tuple[str, str], turn: tuple[str, float], nod: tuple[str, float]
) -> None:
    span = RANGE[PARAMETERS[INDEX[turn[0]]].kind]
    values = at_one_second(
        turned(dict([turn]), "slow", channels[0]),
        turned(dict([nod]), "quick", channels[1]),
        conflict=conflict,
    )
    assert values[turn[0]] == pytest.approx(turn[1] / (1 + abs(nod[1]) / (2 * span)), abs=1e-9)
    assert values[nod[0]] == pytest.approx(nod[1] / (1 + abs(turn[1]) / (2 * span)), abs=1e-9)


def test_ten_and_minus_six_degrees_give_what_the_paper_page_says() -> None:
    values = at_one_second(turned({"head_yaw": 10.0}, "a"), turned({"head_pitch": -6.0}, "b"))
    assert (round(values["head_yaw"], 2), round(values["head_pitch"], 2)) == (8.70, -4.80)


@pytest.mark.parametrize(
    "targets", [{"head_yaw": 9.0, "head_pitch": -7.0, "head_roll": 4.0}, {"head_yaw": 31.0}]
)
def test_a_movement_alone_is_exact_about_all_its_axes(targets: dict[str, float]) -> None:
    values = at_one_second(turned(targets, "a"))
    assert {name: values[name] for name in targets} == targets


def test_head_and_eyes_do_not_make_each_other_smaller() -> None:
    values = at_one_second(turned({"head_yaw": 9.0}, "a"), turned({"gaze_yaw": -14.0}, "b", "gaze"))
    assert (values["head_yaw"], values["gaze_yaw"]) == (9.0, -14.0)


def test_a_curve_drawn_by_hand_stays_as_drawn_beside_turns_about_other_axes() -> None:
    drawn = ManualCurve({"head_yaw": ((0.0, 10.0), (2.0, 10.0))}, replaces=True)
    values = at_one_second(turned({"head_pitch": -6.0, "head_yaw": 3.0}, "a"), manual=(drawn,))
    assert values["head_yaw"] == 10.0
    assert values["head_pitch"] == pytest.approx(-6.0 / 1.25, abs=1e-9)


def test_what_is_explained_and_traced_is_what_is_performed() -> None:
    score = Score(2.0, (turned({"head_yaw": 10.0}, "a"), turned({"head_pitch": -6.0}, "b", "emotion")))
    plan = blend.Plan(score)
    times = np.linspace(0.0, 2.0, 9)
    for name in ("head_yaw", "head_pitch"):
        curve = plan.at(times)[:, INDEX[name]]
        assert np.sum([t.applied for t in blend.traces(plan, name, times)], axis=0) == pytest.approx(curve)
        explained = blend.explain(plan, 1.0, name)
        assert explained.value == pytest.approx(curve[4])
        assert explained.winner is not None
        assert explained.winner.applied == pytest.approx(curve[4])
        assert "smaller" in explained.winner.reason


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
