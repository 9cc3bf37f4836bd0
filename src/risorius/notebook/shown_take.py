"""A take as a notebook shows it, and the curves that are worth a line."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ..core.arrays import Array
from ..core.parameters import BASES, INDEX, Kind
from ..core.performance import Performance
from ..core.speech.audio import Audio
from ..core.speech.utterance import Utterance

MOST = 8  # curves of a figure
_LEAST = 0.05  # that a curve moves, to be shown


class ShownTake(Protocol):
    """A performance with its utterance, as a `Take` is."""

    @property
    def performance(self) -> Performance:
        """The curves and the score that they were made from."""

    @property
    def utterance(self) -> Utterance | None:
        """The utterance; None if nothing is said."""

    @property
    def audio(self) -> Audio | None:
        """The sound that is heard; None for a silent take."""


def liveliest(performance: Performance) -> dict[str, Array]:
    """Return curves by name, shape (frames,): the muscles and contacts, 0 to 1, that move most, both sides'
    mean, in the order of the table.
    """
    means: dict[str, Array] = {
        base: np.mean([performance.values[:, INDEX[side.name]] for side in sides], axis=0)
        for base, sides in BASES.items()
        if sides[0].kind in (Kind.MUSCLE, Kind.CONTACT)
    }
    moved = sorted(((float(np.ptp(curve)), name) for name, curve in means.items()), reverse=True)
    kept = {name for range_, name in moved[:MOST] if range_ >= _LEAST}
    return {name: curve for name, curve in means.items() if name in kept}
