"""Antagonists among the targets of one movement: muscles that conflict and are contracted together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from .parameters import RIVALS

# Sums of rounded shares are not over 1 by this.
_ROUNDING = 1e-9


def antagonist_pairs(targets: Mapping[str, float]) -> Iterator[tuple[str, str]]:
    """Yield the larger and the smaller of all conflicting targets that sum above 1; of equals the first is
    the larger.

    Below that they are a co-contraction, as in a tense face.
    """
    names = list(targets)
    for index, one in enumerate(names):
        for other in names[index + 1 :]:
            if other in RIVALS[one] and targets[one] + targets[other] > 1.0 + _ROUNDING:
                yield (one, other) if targets[one] >= targets[other] else (other, one)


def without_antagonists(targets: Mapping[str, float]) -> dict[str, float]:
    """Return targets in which of conflicting ones the smaller is at most 1 less the larger (paper A, section
    2: a channel holds only movements that do not conflict).
    """
    shares = dict(targets)
    for larger, smaller in antagonist_pairs(targets):
        shares[smaller] = min(shares[smaller], max(1.0 - targets[larger], 0.0))
    return shares
