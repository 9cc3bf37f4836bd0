from pathlib import Path

import pytest

from risorius.errors import OutputError
from risorius.ports.formats import OUTPUTS, Need, output_for


def test_a_name_without_suffix_is_refused_with_the_list() -> None:
    with pytest.raises(OutputError, match=r"^clip: the name has no suffix; expected one of \.mp4, "):
        output_for(Path("clip"))


@pytest.mark.parametrize(
    ("name", "nearest"),
    [
        ("x.mp5", ".mp4"),
        ("x.muscle.csv", ".muscles.csv"),
        ("x.csv", ".muscles.csv"),
        ("x.textgird", ".TextGrid"),
        ("material.1.scores.json", ".score.json"),
    ],
)
def test_an_unknown_suffix_names_the_nearest_and_all(name: str, nearest: str) -> None:
    with pytest.raises(OutputError) as caught:
        output_for(Path("out") / name)
    assert f"did you mean '{nearest}'?" in str(caught.value)
    assert all(suffix in str(caught.value) for suffix in OUTPUTS)


def test_a_suffix_near_to_none_gets_the_list() -> None:
    with pytest.raises(OutputError, match=r"unknown suffix '\.qqqqqq'; expected one of"):
        output_for(Path("x.qqqqqq"))


@pytest.mark.parametrize(
    ("name", "suffix"),
    [
        ("x.png", ".png"),
        ("x.score.json", ".score.json"),
        ("X.MP4", ".mp4"),
        ("x.textgrid", ".TextGrid"),
        ("a.b.muscles.csv", ".muscles.csv"),
    ],
)
def test_the_longest_suffix_wins_in_any_case(name: str, suffix: str) -> None:
    assert output_for(Path(name)).suffix == suffix


def test_every_format_says_what_it_holds_and_needs() -> None:
    outputs = [OUTPUTS.get(suffix) for suffix in OUTPUTS]
    assert all(o.description and o.needs <= set(Need) and o.needs for o in outputs)
