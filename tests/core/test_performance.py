from fractions import Fraction

import numpy as np
import pytest

from risorius.core.frame_rate import parse_fps
from risorius.core.parameters import NAMES
from risorius.core.performance import Performance, announced, frame_count, frame_times
from risorius.core.score import Score
from risorius.errors import InputError


@pytest.mark.parametrize("fps", ["", "x", "0", "-5", "1/0", "1001", "nan", float("inf"), float("nan")])
def test_bad_frame_rates(fps: str | float) -> None:
    with pytest.raises(InputError, match="fps"):
        parse_fps(fps)


def test_rational_rates_are_exact() -> None:
    assert parse_fps("24000/1001") == Fraction(24000, 1001)
    assert parse_fps(29.97) == Fraction(2997, 100)


def test_frames_lie_at_k_over_fps() -> None:
    fps = Fraction(24000, 1001)
    times = frame_times(10.0, fps)
    assert len(times) == frame_count(10.0, fps) == round(10 * fps) + 1
    np.testing.assert_allclose(times, np.arange(len(times)) / float(fps), rtol=1e-15)


def test_curves_are_shown_in_one_line() -> None:
    performance = Performance(Score(1.0), Fraction(30), np.zeros((31, len(NAMES))))
    assert repr(performance.curves) == "<CurvesByName: 46 curves of 31 frames>"
    assert repr(performance) == "<Performance of 1.00 s, 31 frames at 30 per second>"


ANNOUNCED = ["Combining 108,001 frames (40 MB of curves) …"]


@pytest.mark.parametrize(("duration", "said"), [(10.0, []), (3600.0, ANNOUNCED)])
def test_many_frames_are_announced(duration, said):
    lines: list[str] = []
    score = Score(duration)
    assert announced(score, Fraction(30), lines.append) is score
    assert lines == said
