"""Edges between phones, placed where the sound changes as it does between sounds of their classes.

The decoder's edges are 10 ms coarse and biased, by up to 50 ms, in ways that depend on the two sounds. Each
is first corrected by the median error of its pair of classes, then moved to the best of the candidates within
40 ms. A candidate's score is linear in what the spectrum does around it: the step of the levels in 12 bands,
the levels before and after, their sum from the corrected edge on, and the distance moved; the weights are
those of the class to the left and of that to the right, with a share common to all (a conditional logit,
McFadden 1974; boundaries refined by classifiers per pair of classes: Lee 2006; Lo and Wang 2007). All edges
of a stretch are chosen together so that no phone vanishes. The numbers stand in `data/edges.npz`, and how
they were learned in `data/PROVENANCE.md`.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...core.arrays import AnyArray, Array, Int64Array
from ...errors import InputError
from ...languages.phones import SoundClass, inventory
from ...machine.npz import read_arrays
from ...reading.frozen import FrozenDict
from .spectra import BANDS, STEP_SECONDS

# Candidates to either side of a corrected edge, in steps of 2.5 ms.
REACH = 16
# Steps: what is compared directly before and after an edge, and beyond.
_NEAR, _FAR = 4, 11
_BY_BAND = ("step", "before", "after", "sum")
FEATURES = (
    *(f"{name}_{band}" for name in _BY_BAND for band in range(1, BANDS + 1)),
    "change_near",
    "change_far",
    "distance",
    "distance_squared",
)
"""The features of candidates: levels by band, how much they change, and the distance moved."""
CLASSES = tuple(SoundClass)
SHORTEST_STEPS = 4
FILE = "edges.npz"


@dataclass(frozen=True, slots=True)
class EdgeModel:
    """The learned weights, by classes of phones; `numbers` has the place of each phone's class in CLASSES.

    `bias` (classes, classes) in seconds; the weights `left` and `right` (classes, features) of the class to
    the left and of that to the right.
    """

    numbers: Mapping[str, int]
    bias: Array
    left: Array
    right: Array

    def classes(self, symbols: Sequence[str]) -> Int64Array:
        """Return the classes of phones, "" being silence."""
        return np.array([self.numbers[symbol] for symbol in symbols], dtype=np.int64)

    def corrected(self, symbols: Sequence[str], edges: Array) -> Array:
        """Return the edges (n - 1,) between n phones less the bias of their classes, in order still."""
        classes = self.classes(symbols)
        moved = edges - self.bias[classes[:-1], classes[1:]]
        return np.asarray(np.maximum.accumulate(moved))

    def scores(self, symbols: Sequence[str], features: Array) -> Array:
        """Return the scores (n - 1, candidates) of `features` (n - 1, candidates, features)."""
        classes = self.classes(symbols)
        weights = self.left[classes[:-1]] + self.right[classes[1:]]
        return np.asarray(np.einsum("ecf,ef->ec", features, weights))


def place_edges(levels: Array, symbols: Sequence[str], edges: Array) -> Array:
    """Return better times for the `edges` (n - 1,) in seconds between n phones, in order.

    `levels` are those of the whole stretch of sound (`spectra.band_levels`), whose start is time 0.
    """
    if not len(edges):
        return edges
    model = edge_model()
    steps = np.round(model.corrected(symbols, edges) / STEP_SECONDS).astype(np.int64)
    scores = model.scores(symbols, candidate_features(levels, steps))
    return np.asarray(best_in_order(steps, scores) * STEP_SECONDS, dtype=np.float64)


def candidate_features(levels: Array, steps: Int64Array) -> Array:
    """Return the features of the candidates within REACH of each step: (n, 2 REACH + 1, features)."""
    count = len(levels)
    sums = np.concatenate((np.zeros((1, BANDS)), np.cumsum(levels, axis=0)))
    at = steps[:, None] + np.arange(-REACH, REACH + 1)

    def mean(first: int, last: int) -> Array:
        begin = np.clip(at + first, 0, count - 1)
        end = np.clip(at + last, begin + 1, count)
        return np.asarray((sums[end] - sums[begin]) / (end - begin)[..., None])

    step = mean(0, _NEAR) - mean(-_NEAR, 0)
    before, after = mean(-_FAR, -_NEAR), mean(_NEAR, _FAR)
    total = (sums[np.clip(at, 0, count)] - sums[np.clip(steps, 0, count)][:, None]) / REACH
    distance = np.broadcast_to((np.arange(-REACH, REACH + 1) / REACH)[:, None], (*at.shape, 1))
    change = np.stack([np.abs(step).mean(axis=-1), np.abs(after - before).mean(axis=-1)], axis=-1)
    return np.concatenate((step, before, after, total, change, distance, distance**2), axis=-1)


def best_in_order(steps: Int64Array, scores: Array) -> Int64Array:
    """Return the steps with the greatest sum of scores in which every edge is SHORTEST_STEPS after the last.

    Candidates lie within REACH of `steps` (n,), their scores are (n, 2 REACH + 1). If even that leaves no
    room, edges follow one another at that distance.
    """
    offsets = np.arange(-REACH, REACH + 1)
    best = scores[0].copy()
    choices: list[Int64Array] = []
    for index in range(1, len(steps)):
        # The last candidate of the edge before that leaves room for each candidate of this one.
        latest = np.minimum(steps[index] - steps[index - 1] - SHORTEST_STEPS + offsets + REACH, 2 * REACH)
        leaders = _running_argmax(best)
        choice = np.where(latest >= 0, leaders[np.maximum(latest, 0)], 0)
        best = scores[index] + np.where(latest >= 0, best[choice], -np.inf)
        if not np.isfinite(best).any():
            best = scores[index].copy()
        choices.append(choice)
    chosen = [int(np.argmax(best))]
    for choice in reversed(choices):
        chosen.append(int(choice[chosen[-1]]))
    placed = steps + offsets[chosen[::-1]]
    ladder = SHORTEST_STEPS * np.arange(len(placed))
    return np.asarray(np.maximum.accumulate(placed - ladder) + ladder)


def _running_argmax(values: Array) -> Int64Array:
    """Return where the greatest of values[: i + 1] stands, for each i."""
    new = values > np.concatenate(([-np.inf], np.maximum.accumulate(values)[:-1]))
    return np.asarray(np.maximum.accumulate(np.where(new, np.arange(len(values)), 0)))


@functools.cache
def edge_model() -> EdgeModel:
    """Return the package's model; raise InputError if its arrays do not fit together."""
    return model_of(read_arrays(Path(__file__).parent / "data" / FILE))


def model_of(arrays: Mapping[str, AnyArray]) -> EdgeModel:
    """Return the model of an archive's arrays; raise InputError if one is missing or does not fit.

    `classes` and `features` name rows and columns; `bias` (classes, classes) is in seconds; `common`
    (features,) is added to the weights `left` (classes, features), and not to `right` (classes, features).
    """
    for name, expected in (("classes", CLASSES), ("features", FEATURES)):
        if tuple(arrays.get(name, ())) != tuple(expected):
            raise InputError(f"{FILE}: '{name}' are not those of this version; run tools/fit_edges.py")
    count, width = len(CLASSES), len(FEATURES)
    shapes = {"bias": (count, count), "common": (width,), "left": (count, width), "right": (count, width)}
    for name, shape in shapes.items():
        if name not in arrays or arrays[name].shape != shape:
            raise InputError(f"{FILE}: '{name}' is missing or has another shape; expected {shape}")
    bias, left, right = arrays["bias"], arrays["left"] + arrays["common"], arrays["right"]
    numbers = {phone: CLASSES.index(sound) for phone, sound in inventory().sound_classes().items()}
    for array in (bias, left, right):
        array.setflags(write=False)
    return EdgeModel(FrozenDict(numbers), bias, left, right)
