"""Lip segments blended with the least effort."""

from __future__ import annotations

import gc
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.blend.mouth.coarticulation import LIP_MODELS, SegmentValues, without_gaps
from risorius.blend.mouth.effort import CACHED, EFFORT, HELD, PART, EffortModel, _System
from risorius.core.movement import LipSegment
from risorius.core.speech.utterance import SILENCE
from tests.profiles import examples

JAW = "masseter"


def curve(segments: list[LipSegment], times: np.ndarray) -> np.ndarray:
    model = EffortModel(without_gaps(segments))
    return model.averages(model.group(JAW), [SegmentValues(model.targets(JAW))], times)[0]


def segment(phone: str, start: float, end: float, value: float, precision: float = 1.0) -> LipSegment:
    return LipSegment(phone, start, end, {JAW: value}, precision={"*": precision})


def row(*phones: tuple[str, float, float, float]) -> list[LipSegment]:
    """Segments one after the other from 0 on: phone, seconds, target, precision."""
    start, found = 0.0, []
    for phone, seconds, value, precision in phones:
        found.append(segment(phone, start, start + seconds, value, precision))
        start += seconds
    return found


@st.composite
def phones(draw: st.DrawFn) -> list[LipSegment]:
    start, found = 0.0, []
    for _ in range(draw(st.integers(1, 10))):
        end = start + draw(st.floats(0.02, 0.4))
        found.append(segment("AA", start, end, draw(st.floats(0, 1)), draw(st.floats(0.1, 8))))
        start = end + draw(st.sampled_from((0.0, 0.05, 0.3)))
    return found


def test_registered_by_name() -> None:
    assert LIP_MODELS.get("effort") is EffortModel


@examples(25)
@given(phones())
def test_weights_are_shares_of_the_curve(found: list[LipSegment]) -> None:
    model = EffortModel(without_gaps(found))
    times = np.arange(0.0, found[-1].end, 0.007)
    weights = model.weights(model.group(JAW), times)
    assert weights.average(np.ones(len(model.targets(JAW)))) == pytest.approx(np.ones(len(times)), abs=1e-6)
    assert weights.average(model.targets(JAW)) == pytest.approx(curve(found, times), abs=1e-9)
    assert weights.weight.min() > -0.3


@examples(25)
@given(phones(), st.floats(0.0, 30.0))
def test_shifted_segments_give_the_shifted_curve(found: list[LipSegment], shift: float) -> None:
    times = np.arange(-0.5, found[-1].end + 0.5, 0.01)
    moved = [replace(s, start=s.start + shift, end=s.end + shift) for s in found]
    assert curve(moved, times + shift) == pytest.approx(curve(found, times), abs=1e-6)


@examples(25)
@given(phones())
def test_the_curve_has_no_kinks(found: list[LipSegment]) -> None:
    def sharpest(step: float) -> float:
        return float(np.abs(np.diff(curve(found, np.arange(-0.2, 1.0, step)), 2)).max())

    # A kink falls 4-fold, a bend 16-fold.
    assert sharpest(0.0005) <= sharpest(0.002) / 12.0 + 1e-9


def test_it_is_the_curve_of_least_effort() -> None:
    """A dense grid finds the same by plain finite differences."""
    found = without_gaps(row(("AA", 0.13, 0.8, 1.0), ("B", 0.06, -0.2, 6.0), ("IY", 0.1, 0.4, 1.0)))
    step = 0.0005
    grid = np.arange(-0.4, 0.7, step)
    held, pull = np.zeros(len(grid)), np.zeros(len(grid))
    for s in found:
        edge = 0.06 if s.phone == "" else 0.1 * (s.end - s.start)
        inside = (grid >= s.start + edge) & (grid < s.end - edge)
        held[inside] += s.precision_of(JAW)
        pull[inside] += s.precision_of(JAW) * s.targets.get(JAW, 0.0)
    bend = np.diff(np.eye(len(grid)), 2, axis=0) / step**2
    least = np.linalg.solve(np.diag(held) + EFFORT * bend.T @ bend, pull)
    middle = (grid > -0.1) & (grid < 0.4)
    assert curve(found[1:-1], grid)[middle] == pytest.approx(least[middle], abs=0.01)


class TestShape:
    def test_a_vowel_between_weak_consonants_reaches_nine_tenths(self) -> None:
        found = row(*[("T", 0.07, 0.0, 0.4), ("AA", 0.1, 1.0, 1.0)] * 6, ("T", 0.07, 0.0, 0.4))
        assert curve(found, np.arange(0.4, 0.7, 0.002)).max() >= 0.9

    def test_a_consonant_as_precise_as_a_vowel_moves_seven_tenths_of_the_way(self) -> None:
        found = row(("AA", 0.2, 1.0, 1.0), ("T", 0.08, 0.0, 1.0), ("AA", 0.2, 1.0, 1.0))
        assert curve(found, np.arange(0.2, 0.28, 0.002)).min() <= 0.3

    def test_an_extremum_lies_in_the_middle_of_its_phone(self) -> None:
        found = row(("T", 0.07, 0.0, 0.5), ("AA", 0.12, 1.0, 1.0), ("K", 0.06, 0.3, 0.5))
        times = np.arange(0.0, 0.25, 0.001)
        assert times[np.argmax(curve(found, times))] == pytest.approx(0.13, abs=0.01)

    def test_an_imprecise_segment_takes_its_neighbours_shape(self) -> None:
        around = ("AA", 0.15, 0.8, 1.0)
        middle = np.array([0.19])
        weak, strong = (curve(row(around, ("L", 0.08, 0.0, p), around), middle)[0] for p in (0.1, 6.0))
        assert weak > 0.5 > 0.05 > strong

    def test_rest_long_before_and_after(self) -> None:
        values = curve([segment("AA", 1.0, 1.2, 0.7)], np.array([-3.0, 0.3, 2.0, 5.0]))
        assert values == pytest.approx(np.zeros(4), abs=1e-4)

    def test_a_long_phone_stands_at_its_target(self) -> None:
        assert curve([segment("AA", 1.0, 2.0, 0.7)], np.array([1.5])) == pytest.approx([0.7], abs=1e-3)

    def test_without_any_precision_the_lips_rest(self) -> None:
        model = EffortModel((segment("HH", 0.0, 0.1, 0.5, 0.0),))
        assert model.weights(model.group(JAW), np.array([0.05])).average(model.targets(JAW)) == [0.0]

    def test_segments_of_no_length_and_on_one_another_are_blended(self) -> None:
        found = [segment("AA", 0.0, 0.2, 0.8), segment("T", 0.1, 0.10001, 0.0), segment("AA", 0.1, 0.3, 0.8)]
        values = curve(found, np.arange(-0.5, 0.8, 0.01))
        assert np.isfinite(values).all()
        assert 0.6 < values.max() < 0.9


@examples(25)
@given(phones(), phones(), st.floats(0.16, 0.5))
def test_what_follows_a_pause_bends_nothing_until_half_a_second_before_it(
    found: list[LipSegment], others: list[LipSegment], pause: float
) -> None:
    """In the pause the mouth rests, or takes a breath."""
    end = found[-1].end
    breath = LipSegment(SILENCE, end, end + pause, {JAW: 0.3})
    after = [replace(s, start=s.start + end + pause, end=s.end + end + pause) for s in others]
    times = np.arange(-0.5, end - HELD, 0.01)
    assert curve([*found, breath, *after], times) == pytest.approx(curve(found, times), abs=1e-9)


def test_a_part_of_the_curve_is_the_same_whatever_follows_the_pause_at_its_end() -> None:
    times = np.arange(PART - 1.0, PART, 0.01)
    said = segment("AA", PART - 2.0, PART + HELD + 0.1, 0.7)
    after = segment("AA", said.end + 0.3, said.end + 0.6, 1.0, 0.1)
    assert curve([said, after], times) == pytest.approx(curve([said], times), abs=1e-9)


def test_systems_go_with_their_parts() -> None:
    long = [segment("AA", start, start + 8.0, 0.5) for start in np.arange(0.0, 20 * PART, 8.0)]
    model = EffortModel(without_gaps(long))
    values = [SegmentValues(model.targets(JAW))]
    gc.collect()
    others = {id(it) for it in _systems()}
    for part in range(20):
        model.averages(model.group(JAW), values, np.array([part * PART + 1.0]))
    assert sum(id(it) not in others for it in _systems()) <= CACHED


def _systems() -> list[_System]:
    return [it for it in gc.get_objects() if isinstance(it, _System)]
