"""Head and gaze: turns of several channels are summed, each made smaller by the others, about any axis."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from ..core.arrays import Array
from ..core.parameters import INDEX, PARAMETERS, Kind

RANGE: dict[Kind, float] = {Kind.HEAD: 20.0, Kind.GAZE: 25.0, Kind.DISTANCE: 0.8}
"""The range of each kind, in degrees or metres, over which one movement makes others much smaller."""


AxisTurns = Mapping[str, Array]
"""A term: deviations about the axes that one layer turns, by parameter, shape (n,) each."""


def combine_directions(name: str, shares: Sequence[Array]) -> Array:
    """Return one parameter, with its neutral, from the shares of all curves that turn it, shape (n,).

    The result is clipped to the parameter's range.
    """
    parameter = PARAMETERS[INDEX[name]]
    total = parameter.neutral + np.sum(shares, axis=0)
    return np.asarray(np.clip(total, parameter.low, parameter.high))


def shares_of(kind: Kind, terms: Sequence[AxisTurns], exact: Collection[int] = ()) -> list[AxisTurns]:
    """Return each deviation from the neutral, reduced by the other terms; values of shape (n,).

    x_c / (1 + ½ Σ_{d≠c} |x_d| / R): |x_d| is the length of a term over all its axes. A single term is exact;
    a slow turn and a nod show together, both smaller (paper B, section 4.4; DESIGN, section 3). Terms in
    `exact`, by their index, are reduced only by the others that turn the same axis.
    """
    span = RANGE[kind]
    sizes = [np.sqrt(sum(x * x for x in term.values())) for term in terms]
    whole = np.sum(sizes, axis=0) if sizes else 0.0
    shares: list[AxisTurns] = []
    for index, (term, size) in enumerate(zip(terms, sizes, strict=True)):
        if index in exact:
            shares.append({axis: _alone(axis, x, terms, span) for axis, x in term.items()})
        else:
            factor = 1.0 / (1.0 + 0.5 * (whole - size) / span)
            shares.append({axis: x * factor for axis, x in term.items()})
    return shares


def _alone(axis: str, value: Array, terms: Sequence[AxisTurns], span: float) -> Array:
    """Return a deviation about one axis, reduced by the other terms about that axis alone."""
    size = np.sum([np.abs(term[axis]) for term in terms if axis in term], axis=0)
    return np.asarray(value / (1.0 + 0.5 * (size - np.abs(value)) / span))
