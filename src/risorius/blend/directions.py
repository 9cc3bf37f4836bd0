"""Head and gaze: directions from several channels are summed, each made smaller by the others."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.arrays import Array
from ..core.parameters import INDEX, PARAMETERS, Kind

RANGE: dict[Kind, float] = {Kind.HEAD: 20.0, Kind.GAZE: 25.0, Kind.DISTANCE: 0.8}
"""The range of each kind, in degrees or metres, over which one movement makes others much smaller."""


def combine_directions(name: str, shares: Sequence[Array]) -> Array:
    """Return one parameter, with its neutral, from the shares of all curves that turn it, shape (n,).

    The result is clipped to the parameter's range.
    """
    parameter = PARAMETERS[INDEX[name]]
    total = parameter.neutral + np.sum(shares, axis=0)
    return np.asarray(np.clip(total, parameter.low, parameter.high))


def shares_of(name: str, terms: Sequence[Array]) -> list[Array]:
    """Return each deviation from a direction's neutral, reduced by the other terms, shape (n,) each.

    x_c / (1 + ½ Σ_{d≠c} |x_d| / R): a single term is exact; a slow turn and a nod show together, both smaller
    (DESIGN, section 3).
    """
    span = RANGE[PARAMETERS[INDEX[name]].kind]
    size = np.sum([np.abs(x) for x in terms], axis=0)
    return [x / (1.0 + 0.5 * (size - np.abs(x)) / span) for x in terms]
