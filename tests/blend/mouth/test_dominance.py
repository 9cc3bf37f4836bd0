"""Lip segments blended by dominance."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.blend.mouth.coarticulation import LIP_MODELS, SHORTEST_SILENCE, without_gaps
from risorius.blend.mouth.dominance import DominanceModel
from risorius.core.movement import Dominance, LipSegment, silent_dominance
from tests.profiles import examples

JAW = "masseter"


def curve(segments: list[LipSegment], times: np.ndarray, name: str = JAW) -> np.ndarray:
    model = DominanceModel(without_gaps(segments))
    return model.weights(model.group(name), times).average(model.targets(name))


def segment(phone: str, start: float, end: float, value: float | None = None, **more: object) -> LipSegment:
    targets = {} if value is None else {JAW: value}
    return LipSegment(phone, start, end, targets, **more)  # type: ignore[arg-type]


@st.composite
def phones(draw: st.DrawFn) -> list[LipSegment]:
    start, found = 0.0, []
    for _ in range(draw(st.integers(1, 10))):
        end = start + draw(st.floats(0.02, 0.4))
        dominance = Dominance(
            draw(st.floats(0.1, 8)), draw(st.floats(0.01, 0.12)), draw(st.floats(0.01, 0.12)),
            draw(st.sampled_from((1.0, 1.5, 2.0))), draw(st.floats(0, 1)),
        )  # fmt: skip
        found.append(segment("AA", start, end, draw(st.floats(0, 1)), dominance={"*": dominance}))
        start = end + draw(st.sampled_from((0.0, 0.05, 0.3)))
    return found


def test_registered_by_name() -> None:
    assert LIP_MODELS.get("dominance") is DominanceModel


@examples(40)
@given(phones())
def test_weights_are_shares(found: list[LipSegment]) -> None:
    model = DominanceModel(without_gaps(found))
    times = np.arange(0.0, found[-1].end, 0.003)
    weights = model.weights(model.group(JAW), times)
    assert weights.weight.min() >= 0
    assert weights.average(np.ones(len(model.targets(JAW)))) == pytest.approx(np.ones(len(times)))


@examples(40)
@given(phones())
def test_the_curve_stays_between_the_targets(found: list[LipSegment]) -> None:
    values = curve(found, np.arange(-1.0, found[-1].end + 1, 0.003))
    assert values.min() >= 0
    assert values.max() <= max(s.targets[JAW] for s in found) + 1e-12


def printed(segments: Sequence[LipSegment], times: np.ndarray) -> np.ndarray:
    """The curve by the printed formula, one segment after the other."""
    total, weighted = np.zeros(len(times)), np.zeros(len(times))
    for s in segments:
        d, half = s.dominance_of(JAW), (s.end - s.start) / 2.0
        offset = times - (s.start + s.end) / 2.0
        x = np.maximum(np.abs(offset) - d.plateau * half, 0.0)
        dominance = d.magnitude * np.exp(-((x / np.where(offset < 0.0, d.before, d.after)) ** d.exponent))
        total += dominance
        weighted += dominance * s.targets.get(JAW, 0.0)
    return weighted / total


@examples(40)
@given(phones())
def test_the_curve_is_that_of_the_printed_formula(found: list[LipSegment]) -> None:
    times = np.arange(-0.3, found[-1].end + 0.3, 0.003)
    assert curve(found, times) == pytest.approx(printed(without_gaps(found), times), abs=1e-8)


def test_far_from_all_segments_the_nearest_holds() -> None:
    sharp = {"*": Dominance(1.0, 0.01, 0.01, 2.0)}
    found = [segment("AA", 0.0, 0.1, 0.6, dominance=sharp), segment("AA", 0.2, 0.3, 0.9, dominance=sharp)]
    model = DominanceModel(found)
    weights = model.weights(model.group(JAW), np.array([0.14, 0.16]))
    assert weights.average(model.targets(JAW)) == pytest.approx([0.6, 0.9], abs=1e-3)


class TestShape:
    def test_a_long_phone_reaches_its_target(self) -> None:
        assert curve([segment("AA", 1.0, 2.0, 0.7)], np.array([1.5])) == pytest.approx([0.7], abs=1e-3)

    def test_rest_long_before_and_after(self) -> None:
        values = curve([segment("AA", 1.0, 1.2, 0.7)], np.array([-3.0, -0.2, 2.4, 5.0]))
        assert values == pytest.approx(np.zeros(4), abs=1e-9)

    def test_the_mouth_does_not_open_in_the_middle_of_a_long_silence(self) -> None:
        silent = {"*": silent_dominance(Dominance(), 10.0)}
        found = [segment("", 0.0, 10.0, dominance=silent), segment("AA", 10.0, 10.2, 0.7)]
        assert curve(found, np.array([9.0]))[0] < 1e-6
        assert curve(found, np.array([9.7]))[0] < 0.01

    def test_dominant_neighbours_win(self) -> None:
        strong, weak = {"*": Dominance(5.0)}, {"*": Dominance(0.2)}
        between = [
            segment("AA", 0, 0.2, 0.8),
            segment("K", 0.2, 0.3, 0.0, dominance=weak),
            segment("AA", 0.3, 0.5, 0.8),
        ]
        held = [
            segment("AA", 0, 0.2, 0.8),
            segment("B", 0.2, 0.3, 0.0, dominance=strong),
            segment("AA", 0.3, 0.5, 0.8),
        ]
        middle = np.array([0.25])
        assert curve(between, middle)[0] > 0.4 > 0.2 > curve(held, middle)[0]

    def test_rates_differ_by_side(self) -> None:
        slow_before = {"*": Dominance(1.0, before=0.15, after=0.03)}
        values = curve([segment("UW", 1.0, 1.2, 0.9, dominance=slow_before)], np.array([0.9, 1.3]))
        assert values[0] > 2 * values[1]

    def test_a_short_gap_belongs_to_its_neighbours(self) -> None:
        gap = SHORTEST_SILENCE / 2
        found = [segment("AA", 0.0, 0.3, 0.8), segment("AA", 0.3 + gap, 0.6, 0.8)]
        assert curve(found, np.array([0.3 + gap / 2])) == pytest.approx([0.8], abs=0.02)

    def test_a_long_gap_is_silence(self) -> None:
        found = [segment("AA", 0.0, 0.3, 0.8), segment("AA", 1.3, 1.6, 0.8)]
        assert curve(found, np.array([0.8])) == pytest.approx([0.0], abs=1e-4)

    def test_magnitude_zero_everywhere_is_rest(self) -> None:
        free = {"*": Dominance(0.0)}
        model = DominanceModel((segment("HH", 0, 0.1, 0.5, dominance=free),))
        assert model.weights(model.group(JAW), np.array([0.05])).average(model.targets(JAW)).tolist() == [0]
