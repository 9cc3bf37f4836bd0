"""Columns and their averages: what is worked in parts is what would be worked at once."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from risorius.blend.mouth.coarticulation import (
    AT_ONCE,
    LIP_MODELS,
    TARGET,
    SegmentAverages,
    SegmentTable,
    SegmentValues,
    without_gaps,
)
from risorius.core.movement import Dominance, LipSegment

JAW, WIDTH = "masseter", "lip_width"
LONG = [
    LipSegment(
        "V", k * 0.1, k * 0.1 + 0.1, {JAW: (k % 7) / 7.0, WIDTH: k % 3}, dominance={WIDTH: Dominance(1.5)}
    )
    for k in range(200)
]


@given(arrays(np.float64, st.integers(1, 50), elements=st.floats(-1, 1)))
def test_a_column_holds_every_value(values):
    assert SegmentValues(values)[np.arange(len(values))].tolist() == values.tolist()


def test_a_column_may_have_many_values():
    values = np.linspace(0.0, 1.0, 2**16 + 5)
    assert SegmentValues(values)[np.arange(len(values))].tolist() == values.tolist()


@pytest.mark.parametrize("name", list(LIP_MODELS))
def test_averages_do_not_depend_on_how_many_times_are_worked_at_once(name):
    model = LIP_MODELS.get(name)(without_gaps(LONG))
    columns = SegmentTable(model, {(TARGET, n): SegmentValues(model.targets(n)) for n in (JAW, WIDTH)})
    times = np.linspace(-1.0, 21.0, 3 * AT_ONCE + 11)
    average = SegmentAverages(columns, times)
    for parameter in (JAW, WIDTH):
        weights = model.weights(model.group(parameter), times)
        expected = weights.average(model.targets(parameter))
        assert average(parameter) == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert not average.of("no such kind", JAW).any()


def test_threads_that_ask_for_the_same_get_the_same():
    model = LIP_MODELS.get("dominance")(without_gaps(LONG))
    columns = SegmentTable(model, {(TARGET, n): SegmentValues(model.targets(n)) for n in (JAW, WIDTH)})
    times = np.linspace(-1.0, 21.0, AT_ONCE)
    alone = SegmentAverages(columns, times)(JAW).tolist()
    with ThreadPoolExecutor(8) as threads:
        for _ in range(20):
            average = SegmentAverages(columns, times)
            assert all(found.tolist() == alone for found in threads.map(average, [JAW] * 8))
