"""Head and gaze: directions from several channels are summed, each made smaller by the others."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.arrays import Array
from ..core.parameters import INDEX, PARAMETERS, Kind

RANGE: dict[Kind, float] = {Kind.HEAD: 20.0, Kind.GAZE: 25.0, Kind.DISTANCE: 0.8}
"""How far a parameter of each kind moves before it makes others much smaller: degrees, metres."""


def combine_directions(name: str, terms: Sequence[Array]) -> Array:
    """Return one parameter, with its neutral, from the deviations of all channels and layers, shape (n,).

    The sum of x_c / (1 + ½ Σ_{d≠c} |x_d| / R): a lone term is exact, a slow turn and a nod coexist,
    smaller (DESIGN, section 3). Clipped to the parameter's range.
    """
    parameter = PARAMETERS[INDEX[name]]
    total = parameter.neutral + np.sum(shares_of(name, terms), axis=0)
    return np.asarray(np.clip(total, parameter.low, parameter.high))


def shares_of(name: str, terms: Sequence[Array]) -> list[Array]:
    """Return each term of a direction as the others leave it, shapes as given."""
    span = RANGE[PARAMETERS[INDEX[name]].kind]
    size = np.sum([np.abs(x) for x in terms], axis=0)
    return [x / (1.0 + 0.5 * (size - np.abs(x)) / span) for x in terms]
