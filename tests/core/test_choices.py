"""Choices: names are those that are registered; ranges and defaults are the same wherever they are used."""

from __future__ import annotations

import inspect

import pytest

from risorius.blend.conflict import POLICIES
from risorius.blend.mouth.coarticulation import LIP_MODELS
from risorius.core import choices, functions
from risorius.core.score import BlendSettings
from risorius.errors import ParameterError
from risorius.render.lights import DARK, DAYLIGHT, RIGS, STUDIO
from risorius.rules.expressions import expressions
from risorius.rules.lips import lip_table
from risorius.settings import BlendChoices, Settings
from risorius.settings.declare import rows
from risorius.speech.synthesis import synthesize_line, synthesize_script


@pytest.mark.parametrize("value", [79, 441, float("nan")])
def test_what_is_out_of_range_is_not_allowed(value: float) -> None:
    assert not choices.RATES.allows(value)


@pytest.mark.parametrize("name", ["lead", "tail"])
def test_a_silence_that_settings_refuse_is_refused_by_the_voice(name: str) -> None:
    with pytest.raises(ParameterError, match=f"{name} 61 is out of range; expected 0 to 60 seconds"):
        synthesize_line("Hello.", **{name: 61})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("names", "registered"),
    [
        (choices.CONFLICT_POLICIES, POLICIES),
        (choices.ONSET_FUNCTIONS, functions.ONSET_FUNCTIONS),
        (choices.LIP_MODELS, LIP_MODELS),
        (choices.MANNERS, lip_table().manners),
        (choices.EXPRESSIONS, expressions()),
    ],
)
def test_names_are_those_that_are_registered(names: tuple[str, ...], registered) -> None:
    assert sorted(names) == sorted(registered)


def test_lights_are_named() -> None:
    assert RIGS == {"studio": STUDIO, "daylight": DAYLIGHT, "dark": DARK}


def test_defaults_of_a_score_and_of_a_plan_are_those_that_stand_here() -> None:
    score, planned = BlendSettings(), BlendChoices().planned()
    for name in ("conflict", "contact", "lips", "rounding"):
        default = getattr(choices, name.upper())
        assert (getattr(score, name), getattr(planned, name)) == (default.score, default.planned)


def test_silences_around_a_script_are_those_of_the_settings() -> None:
    usual = {name: rows(Settings)[name].default for name in ("lead", "tail")}
    said = inspect.signature(synthesize_script).parameters
    assert usual == {name: said[name].default for name in usual} == {"lead": 0.5, "tail": 0.7}
