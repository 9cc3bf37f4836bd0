"""Emotions displayed at the same time, each by an option of its own."""

import pytest

from risorius.channels import ChannelInputs, compose
from risorius.core.parameters import RIVALS
from risorius.rules.emotions import Display
from risorius.rules.fuzzy import blended

SMILE, CORNER = "zygomatic_major.left", "triangularis.left"


@pytest.mark.parametrize(
    "felt",
    [
        {"happiness": 0.7, "sadness": 0.7},
        {"happiness": 0.9, "anger": 0.9},
        {"surprise": 0.6, "disgust": 0.8, "pride": 0.5},
    ],
)
def test_two_options_show_what_one_tag_does(felt: dict[str, float]) -> None:
    displays = tuple(Display(name, intensity) for name, intensity in felt.items())
    shown: dict[str, float] = {}
    for movement in compose(ChannelInputs(3.0, emotions=displays, lively=False)).movements:
        for name, value in movement.parameters.items():
            shown[name] = max(shown.get(name, 0.0), value, key=abs)
    assert {n: v for n, v in shown.items() if v} == pytest.approx(blended(felt))


def test_rivals_give_way_only_while_both_are_displayed() -> None:
    displays = (Display("sadness", 0.7, 0.0, 5.0), Display("happiness", 0.7, 2.0, 3.0))
    found = compose(ChannelInputs(5.0, emotions=displays, lively=False)).movements
    grief = {round(m.start, 3): m.parameters for m in found if "sadness" in m.id}
    assert sorted(grief) == [0.0, 2.0, 3.0]
    assert [CORNER in grief[start] for start in (0.0, 2.0, 3.0)] == [True, False, True]
    smile = next(m.parameters for m in found if "happiness" in m.id)
    assert smile[SMILE] > 0.5
    assert not any(smile.get(a) and grief[2.0].get(b) for a in smile for b in RIVALS[a])
