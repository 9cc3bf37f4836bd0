"""The performance: one curve per parameter, sampled at the frame times."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from .arrays import Array
from .parameters import INDEX, NAMES, parameters_named
from .score import Score


def frame_count(duration: float, fps: Fraction) -> int:
    """Return the number of frames at k/fps, k = 0 … round(duration·fps)."""
    return round(duration * fps) + 1


def frame_times(duration: float, fps: Fraction) -> Array:
    """Return the frame times k/fps in seconds, shape (frames,)."""
    return sample_times(frame_count(duration, fps), fps)


def sample_times(count: int, fps: Fraction) -> Array:
    """Return k/fps for k = 0 … count - 1, correctly rounded, shape (count,)."""
    return np.arange(count, dtype=np.float64) * fps.denominator / fps.numerator


@dataclass(frozen=True, slots=True)
class Performance:
    """Curves, with their score.

    `values`: shape (frames, 46), one column per parameter in the table's order; muscles 0..1, degrees, m.
    """

    score: Score
    fps: Fraction
    values: Array

    @property
    def times(self) -> Array:
        """Frame times in seconds, shape (frames,)."""
        return sample_times(len(self.values), self.fps)

    @property
    def duration(self) -> float:
        """Seconds."""
        return self.score.duration

    def __getitem__(self, name: str) -> Array:
        """Return one parameter's curve, shape (frames,); for a name without its side, the mean of both."""
        if name in INDEX:
            return self.values[:, INDEX[name]]
        columns = [INDEX[p.name] for p in parameters_named(name)]
        return np.asarray(self.values[:, columns].mean(axis=1))

    @property
    def curves(self) -> dict[str, Array]:
        """All curves by name, in the table's order."""
        return {name: self.values[:, i] for i, name in enumerate(NAMES)}
