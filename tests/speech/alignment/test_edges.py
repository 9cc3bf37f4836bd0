"""Edges: the arrays fit together, the best ones in order are found, and a change of sound draws them."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.arrays import AnyArray
from risorius.errors import InputError
from risorius.languages import phonesets
from risorius.speech.alignment.edges import (
    CLASSES,
    FEATURES,
    REACH,
    SHORTEST_STEPS,
    best_in_order,
    edge_model,
    model_of,
    place_edges,
)
from risorius.speech.alignment.spectra import STEP_SECONDS, band_levels

SIZE = len(CLASSES), len(FEATURES)
ARRAYS = {
    "classes": np.array([str(name) for name in CLASSES]),
    "features": np.array(FEATURES),
    "bias": np.zeros((SIZE[0], SIZE[0])),
    "common": np.ones(SIZE[1]),
    "left": np.zeros(SIZE),
    "right": np.zeros(SIZE),
}


@pytest.mark.parametrize(
    ("name", "array", "message"),
    [
        ("classes", ARRAYS["classes"][1:], "'classes' are not those of this version"),
        ("features", ARRAYS["features"][::-1], "'features' are not those of this version"),
        ("bias", np.zeros((2, 2)), r"'bias' is missing or has another shape; expected \(13, 13\)"),
        ("common", np.zeros(3), r"'common' is missing or has another shape; expected \(52,\)"),
        ("left", None, r"'left' is missing or has another shape; expected \(13, 52\)"),
        ("right", np.zeros((13, 51)), r"'right' is missing or has another shape"),
    ],
)
def test_arrays_that_do_not_fit_together_are_refused(name: str, array: AnyArray | None, message: str) -> None:
    arrays = {**ARRAYS, name: array} if array is not None else {k: v for k, v in ARRAYS.items() if k != name}
    with pytest.raises(InputError, match=message):
        model_of(arrays)


def test_common_weights_count_once() -> None:
    model = model_of({**ARRAYS})
    assert (model.left + model.right == 1.0).all()


def test_every_phone_has_a_class() -> None:
    assert set(edge_model().numbers) == phonesets.ARPABET | {""}


def test_biases_are_those_of_an_aligner() -> None:
    assert np.abs(edge_model().bias).max() < 0.1


@given(st.lists(st.integers(0, 40), min_size=2, max_size=3), st.integers(0, 2**32 - 1))
def test_the_best_edges_in_order_are_found(gaps: list[int], seed: int) -> None:
    steps = np.cumsum(gaps)
    offsets = np.arange(-REACH, REACH + 1)
    scores = np.random.default_rng(seed).normal(size=(len(steps), len(offsets)))
    found = best_in_order(steps, scores)
    assert (np.diff(found) >= SHORTEST_STEPS).all()
    chosen = [
        scores[i][step - steps[i] + REACH] for i, step in enumerate(found) if abs(step - steps[i]) <= REACH
    ]
    best = max(
        (
            scores[0][a + REACH] + scores[1][b + REACH]
            for a, b in product(offsets, offsets)
            if steps[1] + b - steps[0] - a >= SHORTEST_STEPS
        ),
        default=-np.inf,
    )
    if len(steps) == 2 and len(chosen) == 2:
        assert sum(chosen) == pytest.approx(best)


@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=12))
def test_edges_stay_in_order(times: list[float]) -> None:
    levels = np.random.default_rng(0).normal(size=(401, 12))
    symbols = ["S" if n % 2 else "AA" for n in range(len(times) + 1)]
    placed = place_edges(levels, symbols, np.array(sorted(times)))
    assert (np.diff(placed) > 0.0).all()


@pytest.mark.parametrize("offset", [-0.025, -0.01, 0.01, 0.025])
def test_an_edge_is_drawn_to_where_a_hiss_becomes_a_vowel(offset: float) -> None:
    rng = np.random.default_rng(1)
    t = np.arange(16_000) / 16_000
    hiss = 1_500 * np.diff(rng.normal(size=16_001))
    vowel = sum(4_000 / k * np.sin(2 * np.pi * 120 * k * t) for k in range(1, 12))
    levels = band_levels(np.where(t < 0.5, hiss, vowel))
    bias = edge_model().bias[edge_model().numbers["S"], edge_model().numbers["AA"]]
    (placed,) = place_edges(levels, ["S", "AA"], np.array([0.5 + bias + offset]))
    assert placed == pytest.approx(0.5, abs=3 * STEP_SECONDS)
