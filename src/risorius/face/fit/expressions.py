"""VRM's preset expressions, by the table `face/fit/data/expressions.toml`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Annotated

import numpy as np

from ...core.arkit import INDEX, SHAPES
from ...core.arrays import Array
from ...core.parameters import INDEX as PARAMETER
from ...core.parameters import NAMES, parameters_named
from ...errors import InputError, unknown
from ...reading.frozen import FrozenDict
from ...reading.hints import Range
from ...reading.toml import package_text, parse_rows

FILE = "expressions.toml"
VOWELS = ("aa", "ih", "ou", "ee", "oh")
"""The presets that open the mouth."""

_Amount = Annotated[float, Range(-2.0, 2.0)]


@dataclass(frozen=True, slots=True)
class Expression:
    """A preset: its name in VRM 0, and either its ARKit shapes or its muscles of emotion, with amounts."""

    vrm0: str
    shapes: Mapping[str, _Amount] = field(default_factory=FrozenDict)
    muscles: Mapping[str, _Amount] = field(default_factory=FrozenDict)

    def __post_init__(self) -> None:
        if bool(self.shapes) == bool(self.muscles):
            raise InputError("has shapes and muscles, or neither; expected one of them")
        for name in self.shapes:
            if name not in INDEX:
                raise InputError(unknown("shape", name, INDEX))
        for name in self.muscles:
            parameters_named(name)


@lru_cache(maxsize=1)
def expressions() -> Mapping[str, Expression]:
    """Return the presets by their name in VRM 1; raise InputError if the table names an unknown shape."""
    return FrozenDict(parse_rows(Expression, package_text(str(__package__), FILE), FILE))


@lru_cache(maxsize=1)
def emotion_presets() -> tuple[str, ...]:
    """Return the presets that emotions alone move."""
    return tuple(name for name, expression in expressions().items() if expression.muscles)


def preset_weights(weights: Array, shut: Array | None = None, emotion: Array | None = None) -> Array:
    """Return the presets' weights (frames, presets) 0..1.

    `weights` (frames, 52) are ARKit's; `shut` (frames,) says by how much vowels are less (`shut_lips`);
    `emotion` (frames, 4) are `emotion_weights`; without them lips are open, and nothing is felt. Vowels that
    together exceed 1 are made smaller in proportion, because avatars add them up.
    """
    names = list(expressions())
    presets = np.clip(weights @ _matrices()[0], 0.0, 1.0)
    vowels = [names.index(name) for name in VOWELS]
    spoken = presets[:, vowels] if shut is None else presets[:, vowels] * (1.0 - shut[:, None])
    presets[:, vowels] = spoken / np.maximum(spoken.sum(axis=1, keepdims=True), 1.0)
    if emotion is not None:
        presets[:, [names.index(name) for name in emotion_presets()]] = emotion
    return presets


def emotion_weights(curves: Array) -> Array:
    """Return the weights 0..1 of `emotion_presets` (frames, 4).

    `curves` (frames, 46) are the parameters that emotions alone move. Weights that together exceed 1 are made
    smaller in proportion.
    """
    felt = np.clip(curves @ _matrices()[1], 0.0, 1.0)
    return np.asarray(felt / np.maximum(felt.sum(axis=1, keepdims=True), 1.0))


@lru_cache(maxsize=1)
def _matrices() -> tuple[Array, Array]:
    """Return the amounts of ARKit's shapes (52, presets), and of parameters (46, presets of emotion)."""
    shapes = np.zeros((len(SHAPES), len(expressions())))
    for column, expression in enumerate(expressions().values()):
        for name, amount in expression.shapes.items():
            shapes[INDEX[name], column] = amount
    muscles = np.zeros((len(NAMES), len(emotion_presets())))
    for column, preset in enumerate(emotion_presets()):
        for name, amount in expressions()[preset].muscles.items():
            sides = parameters_named(name)
            muscles[[PARAMETER[side.name] for side in sides], column] = amount / len(sides)
    for matrix in (shapes, muscles):
        matrix.flags.writeable = False
    return shapes, muscles
