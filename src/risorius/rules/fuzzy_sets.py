"""Fuzzy sets: triangles around centres whose memberships add up to 1, and the rules' weighted average.

Singletons as consequents and the weighted average as defuzzification make a piecewise linear function:
continuous, and monotone if the consequents are.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from ..errors import InputError


def check_centres(centres: Sequence[float]) -> None:
    """Raise InputError unless there are two centres at least, in rising order."""
    if len(centres) < 2 or any(not a < b for a, b in pairwise(centres)):
        raise InputError(
            f"centres {list(centres)} do not increase; expected at least two numbers in increasing order"
        )


def memberships(value: float, centres: Sequence[float]) -> list[float]:
    """Return how far a value belongs to each set, 0..1, in all 1; outside, to the first or last alone."""
    value = min(max(value, centres[0]), centres[-1])
    found = [0.0] * len(centres)
    for i, (low, high) in enumerate(pairwise(centres)):
        if low <= value <= high:
            found[i + 1] = (value - low) / (high - low)
            found[i] = 1.0 - found[i + 1]
            break
    return found


def concluded(value: float, centres: Sequence[float], consequents: Sequence[float]) -> float:
    """Return the average of the rules' values of all sets, weighted by membership."""
    return sum(m * c for m, c in zip(memberships(value, centres), consequents, strict=True))
