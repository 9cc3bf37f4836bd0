"""Weights by name: an array as before, that also knows its shapes."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from risorius.core.arkit import INDEX, SHAPES
from risorius.core.shape_weights import ShapeWeights, named_weights
from risorius.errors import ParameterError

NUMBERS = np.random.default_rng(1).random((3, 52))


def test_names_read_what_indices_read() -> None:
    for weights, numbers in ((named_weights(NUMBERS), NUMBERS), (named_weights(NUMBERS[0]), NUMBERS[0])):
        assert weights.names == SHAPES
        for name in SHAPES:
            found = weights[name]
            assert type(found) is not ShapeWeights
            assert np.array_equal(found, numbers[..., INDEX[name]])


def test_it_is_the_array_that_it_was() -> None:
    weights = named_weights(NUMBERS)
    assert np.shares_memory(weights, NUMBERS)
    assert isinstance(weights, np.ndarray)
    assert weights[1, 2] == NUMBERS[1, 2]
    assert np.array_equal(weights[1:, 3:5], NUMBERS[1:, 3:5])
    assert np.array_equal(weights * 2.0, NUMBERS * 2.0)
    assert weights[1].tolist() == NUMBERS[1].tolist()
    again = pickle.loads(pickle.dumps(weights))
    assert np.array_equal(again["jawOpen"], weights["jawOpen"])


def test_a_frame_cut_from_frames_has_names_and_a_cut_through_the_shapes_has_none() -> None:
    weights = named_weights(NUMBERS)
    assert weights[2]["jawOpen"] == NUMBERS[2, INDEX["jawOpen"]]
    for part in (weights[:, :10], weights[0, :10], weights[0, ::2]):
        assert type(part) is np.ndarray
    with pytest.raises(ParameterError, match="has no names"):
        weights.reshape(-1, 4)["jawOpen"]


def test_an_unknown_name_gets_the_nearest() -> None:
    with pytest.raises(ParameterError, match="did you mean 'jawOpen'"):
        named_weights(NUMBERS)["JawOpen"]
