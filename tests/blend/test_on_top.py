"""Movements on top of a display: x + (1 - x)·F over what the others leave."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.blend import Plan, combine, explain, summarize, traces
from risorius.blend.narrate import narrate
from risorius.core.movement import Cause, Movement
from risorius.core.score import BlendSettings, Score
from risorius.ports.score.score_json import read_score_file, score_to_json

FROWN, RAISE = "corrugator_supercilii.left", "frontalis_medialis.left"
SHARES = st.floats(0.0, 1.0)


def scored(x: float, f: float, policy: str = "graded", on_top: bool = True) -> Score:
    shown = Movement(
        "emotion", 0.0, 4.0, 0.5, 0.5, {FROWN: x}, "display", cause=Cause("emotion.display", "anger")
    )
    added = Movement(
        "punctuators", 1.0, 3.0, 0.5, 0.5, {FROWN: f}, "frown", cause=Cause("frown", "comma"), on_top=on_top
    )
    return Score(4.0, (shown, added), settings=BlendSettings(conflict=policy))


@pytest.mark.parametrize("policy", ["inhibit", "graded", "attenuate"])
@given(SHARES, SHARES)
def test_it_adds_to_what_is_left_above_the_others(policy: str, x: float, f: float) -> None:
    curve = combine(scored(x, f, policy), Fraction(20)).curves[FROWN]
    alone = combine(Score(4.0, (scored(x, f).movements[1],)), Fraction(20)).curves[FROWN]
    display = combine(Score(4.0, (scored(x, f).movements[0],)), Fraction(20)).curves[FROWN]
    assert np.abs(curve - (display + (1.0 - display) * alone)).max() < 1e-12


def test_sum_adds_and_clips() -> None:
    assert combine(scored(0.4, 0.5, "sum"), Fraction(20)).curves[FROWN][40] == pytest.approx(0.9)
    assert combine(scored(0.8, 0.5, "sum"), Fraction(20)).curves[FROWN][40] == 1.0


def test_without_the_mark_the_larger_counts() -> None:
    assert combine(scored(0.7, 0.5, on_top=False), Fraction(20)).curves[FROWN][40] == 0.7


def test_a_rival_of_higher_priority_takes_it_as_all_else() -> None:
    score = scored(0.5, 0.5)
    added = replace(score.movements[1], targets={"zygomatic_major.left": 0.6})
    spoken = Movement("signals", 1.0, 3.0, 0.1, 0.1, {"risorius.left": 1.0}, priority=90.0)
    curve = combine(replace(score, movements=(added, spoken)), Fraction(20)).curves["zygomatic_major.left"]
    assert curve[40] == 0.0


def test_explanations_name_both() -> None:
    plan = Plan(scored(0.7, 0.5))
    found = explain(plan, 2.0, FROWN)
    assert found.value == pytest.approx(0.85)
    assert found.winner is not None
    assert (found.winner.label, found.losers[0].label) == ("display", "frown")
    assert found.losers[0].reason == "on top of anger (emotion)"
    strong = explain(Plan(scored(0.3, 0.5)), 2.0, FROWN)
    assert strong.losers[0].reason == "below comma (punctuators)"
    assert sum(line.strip().startswith("and ") for line in narrate([found], 2.0)) == 1


def test_tallies_and_traces_count_it_as_shown() -> None:
    plan = Plan(scored(0.7, 0.5))
    assert summarize(plan, Fraction(20))["punctuators"].won > 20
    trace = {t.channel: t for t in traces(plan, FROWN, np.array([2.0]))}["punctuators"]
    assert trace.applied[0] == 0.5


def test_a_score_keeps_the_mark(tmp_path: Path) -> None:
    score = scored(0.7, 0.5)
    file = tmp_path / "x.score.json"
    file.write_text(json.dumps(score_to_json(score)))
    assert read_score_file(file).score.movements == score.movements
