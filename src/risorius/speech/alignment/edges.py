"""Edges between phones, placed where the sound changes as it does between sounds of their classes.

The decoder's edges are 10 ms coarse and biased, by up to 50 ms, in ways that depend on the two sounds. Each
is first corrected by the median error of its pair of classes, then moved to the best of the candidates within
40 ms. A candidate's score is linear in what the spectrum does around it: the step of the levels in 12 bands,
the levels before and after, their sum from the corrected edge on, and the distance moved; the weights are
those of the class to the left and of that to the right, with a share common to all (a conditional logit,
McFadden 1974; boundaries refined by classifiers per pair of classes: Lee 2006; Lo and Wang 2007). All edges
of a stretch are chosen together so that no phone vanishes. The numbers, and how they were learned, stand in
`data/edges.toml`.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import resources

import numpy as np

from ...core.arrays import Array, Int64Array
from ...core.frozen import FrozenDict
from ...core.toml import parse
from ...errors import InputError
from .spectra import BANDS, STEP_SECONDS

# Candidates to either side of a corrected edge, in steps of 2.5 ms.
REACH = 16
# Steps: what is compared directly before and after an edge, and beyond.
_NEAR, _FAR = 4, 11
FEATURES = 4 * BANDS + 4
SHORTEST_STEPS = 4


@dataclass(frozen=True, slots=True)
class EdgeTable:
    """The file: `classes` of phones; `bias` in seconds by "LEFT RIGHT"; FEATURES weights per class."""

    classes: Mapping[str, tuple[str, ...]]
    bias: Mapping[str, float]
    common: tuple[float, ...]
    left: Mapping[str, tuple[float, ...]]
    right: Mapping[str, tuple[float, ...]]


@dataclass(frozen=True, slots=True)
class EdgeModel:
    """The table as arrays: classes are numbered; `bias` (classes, classes), weights (classes, FEATURES)."""

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
        """Return the scores (n - 1, candidates) of `features` (n - 1, candidates, FEATURES)."""
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
    """Return what distinguishes the candidates within REACH of each step: (n, 2 REACH + 1, FEATURES)."""
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

    Candidates lie within REACH of `steps` (n,), their scores are (n, 2 REACH + 1). Where even that leaves no
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
    """Return the package's table; raise InputError if it does not fit together."""
    text = resources.files(__package__).joinpath("data/edges.toml").read_text("utf-8")
    return compiled(parse(EdgeTable, text, "edges.toml"))


def compiled(table: EdgeTable) -> EdgeModel:
    """Return a table as arrays; raise InputError for a class without weights or a wrong number of them."""
    order = {name: number for number, name in enumerate(table.classes)}
    rows = {"common": table.common, **_prefixed("left", table.left), **_prefixed("right", table.right)}
    for name, row in rows.items():
        if len(row) != FEATURES:
            raise InputError(f"edges.toml: {name} has {len(row)} weights; expected {FEATURES}")
    if set(table.left) != set(order) or set(table.right) != set(order):
        raise InputError("edges.toml: expected weights on both sides for every class of phones")
    bias = np.zeros((len(order), len(order)))
    for pair, seconds in table.bias.items():
        before, after = pair.split()
        bias[order[before], order[after]] = seconds
    left = np.array([table.left[name] for name in order]) + np.array(table.common)
    right = np.array([table.right[name] for name in order])
    numbers = {phone: order[name] for name, phones in table.classes.items() for phone in phones}
    for array in (bias, left, right):
        array.setflags(write=False)
    return EdgeModel(FrozenDict(numbers), bias, left, right)


def _prefixed(side: str, rows: Mapping[str, tuple[float, ...]]) -> dict[str, tuple[float, ...]]:
    return {f"{side}.{name}": row for name, row in rows.items()}
