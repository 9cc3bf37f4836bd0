"""The shapes of one head at several ages; other ages are interpolated."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...core.arrays import Array
from ...errors import HeadError
from .head_file import HeadFile

FILE = "ages.npz"
YEARS = (0.0, 100.0)


@dataclass(frozen=True, slots=True)
class AgeShapes:
    """Anchors of a head's shape, by ascending age; mm.

    `years` (k,); `rest` (k, N0, 3) of the skin; `eye_centre` (k, 2, 3), `eye_radius` (k, 2), `jaw_point` and
    `head_pivot` (k, 3); `mouth` (k, 3): the shift of teeth and tongue from their place in the head file.
    """

    years: Array
    rest: Array
    eye_centre: Array
    eye_radius: Array
    jaw_point: Array
    head_pivot: Array
    mouth: Array

    def weights(self, age: float) -> Array:
        """Return the anchors' shares (k,) at `age` in years; beyond the first and the last anchor, only that
        one.

        Raises HeadError if the age is not a number from 0 to 100.
        """
        check_age(age)
        anchors = np.eye(len(self.years))
        return np.array([np.interp(age, self.years, anchor) for anchor in anchors])


def check_age(age: float) -> None:
    """Raise HeadError if `age` is not a number of years from 0 to 100."""
    if not YEARS[0] <= age <= YEARS[1]:
        raise HeadError(f"age is {age:g}; expected {YEARS[0]:g} to {YEARS[1]:g} years")


def read_ages(path: Path, rest: Array, own: float) -> AgeShapes:
    """Read the anchors of the head whose skin at rest is `rest` (N0, 3), at its `own` age in years.

    Raises HeadError if an array is missing, misshapen or out of range, or if no anchor has the head's own
    age.
    """
    file = HeadFile.read(path)
    years = file.array("years", ("k",), *YEARS)
    if (np.diff(years) <= 0.0).any():
        raise file.error("years", "does not ascend")
    if own not in years:
        raise file.error("years", f"lacks the head's own age {own:g}")
    count = len(years)
    skins = np.repeat(rest[None], count, axis=0)
    for k in np.flatnonzero(years != own):
        vertices, displacement = file.field(f"rest/{k}", len(rest))
        skins[k, vertices] += displacement
    skins.setflags(write=False)
    return AgeShapes(
        years,
        skins,
        file.array("eye_centre", (count, 2, 3)),
        file.array("eye_radius", (count, 2), low=1.0),
        file.array("jaw_point", (count, 3)),
        file.array("head_pivot", (count, 3)),
        file.array("mouth", (count, 3)),
    )
