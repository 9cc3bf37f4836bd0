"""Wrinkles of the skin by age: paper B's coefficient of compression as a function of age."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...errors import InputError

DEFAULT_AGE = 30.0
YOUNGEST, OLDEST = 0.0, 100.0

# Years; share of its length by which skin shortens before it folds; gain of the folds' height; share of their
# depth at rest. Values at 20, 45 and 70 were judged by eye (facts: face-model, section 6); between them lie
# straight lines.
_YEARS = (0.0, 20.0, 25.0, 45.0, 70.0, 100.0)
_GIVE = (0.14, 0.075, 0.065, 0.03, 0.0, 0.0)
_GAIN = (0.12, 0.33, 0.38, 0.52, 0.72, 0.85)
_STATIC = (0.0, 0.0, 0.0, 0.2, 0.6, 1.0)


class SkinAge(NamedTuple):
    """The folding of skin at an age.

    `give`: the share of its length by which it shortens before it folds; `gain`: a factor on the height of
    folds; `static`: the depth of creases at rest, as a share 0..1 of their greatest depth.
    """

    give: float
    gain: float
    static: float


def skin_at(age: float) -> SkinAge:
    """Return how skin folds at `age` in years, continuous; raise InputError outside 0 to 100."""
    if not YOUNGEST <= age <= OLDEST:
        raise InputError(f"age = {age} is out of range; expected {YOUNGEST:g} to {OLDEST:g}")
    give, gain, static = (float(np.interp(age, _YEARS, column)) for column in (_GIVE, _GAIN, _STATIC))
    return SkinAge(give, gain, static)
