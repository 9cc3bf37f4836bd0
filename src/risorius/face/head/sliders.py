"""Sliders change the shape of any head when it is loaded.

The standard head's folder holds one table for all heads, because they share one topology. A slider moves the
skin in proportion to its amount. Lips and lids move without bending, and teeth, tongue and the jaw's hinge
move with the lips, so that a head's mouth and eyes work in every shape.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from pathlib import Path

import numpy as np

from ...core.arrays import Array
from ...errors import HeadError, unknown
from .head_file import HeadFile

FILE = "sliders.npz"
MOST = 1.0  # the largest amount of a slider, in both directions


@dataclass(frozen=True, slots=True)
class ShapeChange:
    """The sum of sliders, in mm: `skin` (N0, 3), `mouth` (3,) and the `eyes` (2, 3), left and right."""

    skin: Array
    mouth: Array
    eyes: Array


@dataclass(frozen=True, slots=True)
class Sliders:
    """All sliders: `names` (s,), and their displacements in mm at the amounts 1 and −1.

    `skin` (s, 2, N0, 3), `mouth` (s, 2, 3), `eyes` (s, 2, 2, 3).
    """

    names: tuple[str, ...]
    skin: Array
    mouth: Array
    eyes: Array

    def together(self, amounts: Mapping[str, float]) -> ShapeChange:
        """Return the sum of sliders, each times its amount; raises HeadError as `check_sliders`."""
        check_sliders(amounts)
        shares = np.zeros((len(self.names), 2))
        for name, amount in amounts.items():
            shares[self.names.index(name)] = max(amount, 0.0), max(-amount, 0.0)
        return ShapeChange(
            *(np.tensordot(shares, part, axes=2) for part in (self.skin, self.mouth, self.eyes))
        )


def slider_names() -> tuple[str, ...]:
    """Return the names of all sliders."""
    return _names(_path())


def check_sliders(amounts: Mapping[str, float]) -> None:
    """Raise HeadError for a slider that does not exist, and for an amount that is not from −1 to 1."""
    for name, amount in amounts.items():
        if name not in slider_names():
            raise HeadError(unknown("slider", name, slider_names()))
        if not -MOST <= amount <= MOST:
            raise HeadError(f"slider {name} = {amount:g} is out of range; expected {-MOST:g} to {MOST:g}")


def parse_slider(text: str) -> tuple[str, float]:
    """Return name and amount of a text such as "nose_width:0.5"; raise HeadError if it is not like that."""
    name, _, amount = text.partition(":")
    try:
        number = float(amount)
    except ValueError:
        raise HeadError(
            f"shape '{text}' is not a slider with its amount; expected e.g. nose_width:0.5"
        ) from None
    check_sliders({name.strip(): number})
    return name.strip(), number


@lru_cache(maxsize=1)
def load_sliders() -> Sliders:
    """Return the sliders; raise HeadError if their file does not fit."""
    file, names = HeadFile.read(_path()), slider_names()
    count = len(HeadFile.read(_path().with_name("head.npz")).array("rest", ("N", 3)))
    skin = np.zeros((len(names), 2, count, 3))
    for row, name in zip(skin, names, strict=True):
        for part, end in zip(row, "+-", strict=True):
            vertices, displacement = file.field(f"{name}/{end}", count)
            part[vertices] = displacement
    skin.setflags(write=False)
    return Sliders(
        names, skin, file.array("mouth", (len(names), 2, 3)), file.array("eyes", (len(names), 2, 2, 3))
    )


def _path() -> Path:
    return Path(str(resources.files("risorius") / "heads" / "standard" / FILE))


@lru_cache(maxsize=1)
def _names(path: Path) -> tuple[str, ...]:
    return tuple(str(name) for name in HeadFile.read(path).arrays["names"])
