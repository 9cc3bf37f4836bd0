"""Traces: each channel's part in a parameter, and where it was held back."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given

from risorius import blend
from risorius.blend.concatenate import SIGNED
from risorius.core.movement import LipSegment, Movement
from risorius.core.parameters import INDEX, PARAMETERS
from risorius.core.score import Score
from risorius.errors import ParameterError
from tests.profiles import examples

from .strategies import DURATION, scores

SMILE, ROUND = "zygomatic_major.left", "orbicularis_oris_funneler"
HAPPY = Movement("emotion", 0.0, 4.0, 0.4, 0.4, {SMILE: 0.8})
WHO = LipSegment("UW", 2.0, 2.4, {ROUND: 0.9})
PLAN = blend.Plan(Score(4.0, (HAPPY,), (WHO,)))
TIMES = np.arange(0.0, 4.01, 0.01)


def test_an_unknown_parameter_is_refused() -> None:
    with pytest.raises(ParameterError, match="did you mean"):
        blend.traces(PLAN, "zygomatic_major.lefty", TIMES)


def test_nothing_moves_what_no_channel_has() -> None:
    assert blend.traces(PLAN, "tongue_up", TIMES) == ()


def test_no_times() -> None:
    (trace,) = blend.traces(PLAN, SMILE, np.zeros(0))
    assert trace.requested.shape == trace.applied.shape == (0,)


def test_a_smile_is_inhibited_by_rounding_and_limited_around_it() -> None:
    (trace,) = blend.traces(PLAN, SMILE, TIMES)
    assert trace.channel == "emotion"
    ((first, last),) = trace.inhibited
    assert TIMES[first] < 2.2 < TIMES[last]
    assert (trace.applied[first : last + 1] == 0.0).all()
    before, after = trace.limited
    assert before[1] == first - 1
    assert after[0] == last + 1
    assert repr(trace) == "<Trace of emotion at 401 times, 1 times inhibited, 2 limited>"


@examples(10)
@given(scores())
def test_what_channels_apply_makes_the_value(score: Score) -> None:
    spoken = replace(score, lips=(), settings=replace(score.settings, conflict="inhibit"))
    plan = blend.Plan(spoken)
    times = np.linspace(0.0, DURATION, 9)
    shown = plan.at(times)
    for name in plan.moving:
        parts = [trace.applied for trace in blend.traces(plan, name, times)]
        p = PARAMETERS[INDEX[name]]
        whole = np.clip(p.neutral + sum(parts), p.low, p.high) if name in SIGNED else np.max(parts, axis=0)
        np.testing.assert_allclose(whole, shown[:, INDEX[name]], atol=1e-12)
