import pytest

from risorius.core.parameters import INDEX, PARAMETERS
from risorius.errors import InputError, ParameterError
from risorius.rules.load import DATA, parse
from risorius.rules.markup import Direction, Gesture, MarkupTable, TurnAttitude, markup_table

GESTURE = 'parameter = "{}"\namplitude = {}\nswings = [{}]\nseconds = 0.2\ndecay = 0.9\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (GESTURE.format("head_pich", 5, 1), "unknown parameter 'head_pich'; did you mean 'head_pitch'?"),
        (
            GESTURE.format("head_pitch", -5, 1),
            "amplitude = -5 is out of range; expected a number from 0 to 45",
        ),
        (
            GESTURE.format("head_pitch", 5, -2),
            "swings[0] = -2 is out of range; expected a number from -1 to 1",
        ),
    ],
)
def test_gestures_are_checked(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse(Gesture, text, "t.toml")
    assert message in str(caught.value)


def test_directions_and_targets_are_checked() -> None:
    with pytest.raises(InputError, match=r"yaw = 50 is out of range; expected a number from -45 to 45"):
        parse(Direction, "pitch = 0\nyaw = 50", "t.toml")
    with pytest.raises(ParameterError, match=r"AU34 \(cheek puff\) cannot be shown"):
        parse(TurnAttitude, "gaze = { pitch = 0, yaw = 0 }\n[targets]\nAU34 = 1", "t.toml")
    whole = (DATA / "markup.toml").read_text(encoding="utf-8")
    with pytest.raises(ParameterError, match="expected 0 to 1"):
        parse(MarkupTable, whole.replace("[signal]\nAU1 = 0.6", "[signal]\nAU1 = 6"), "t.toml")


def test_directions_go_where_they_say() -> None:
    gaze = markup_table().gaze
    assert gaze["left"].yaw > 0.0 > gaze["right"].yaw
    assert gaze["up"].pitch > 0.0 > gaze["down"].pitch
    assert gaze["listener"] == gaze["camera"] == Direction(0.0, 0.0)
    assert gaze["away"].targets["gaze_yaw"] != 0.0


def test_gestures_stay_within_the_heads_reach() -> None:
    for gesture in markup_table().head.values():
        parameter = PARAMETERS[INDEX[gesture.parameter]]
        assert all(parameter.low <= s * gesture.amplitude <= parameter.high for s in gesture.swings)
