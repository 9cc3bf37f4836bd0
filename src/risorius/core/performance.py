"""The performance: one curve per parameter, sampled at the frame times."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ..errors import InputError, ParameterError, unknown
from .arrays import Array
from .parameters import INDEX, NAMES, parameters_named
from .progress import Progress
from .score import Score

MOST_FRAMES = 1_300_000
"""Frames of a performance: six hours at 60 a second, with 478 MB of curves."""
MANY_FRAMES = 54_000
"""Half an hour at 30 frames a second: more are announced."""


class CurvesByName(dict[str, Array]):
    """Curves by the names of their parameters; ParameterError, with the nearest, for an unknown name."""

    def __repr__(self) -> str:
        """Return one line: how many curves there are, and of how many frames."""
        return f"<CurvesByName: {len(self)} curves of {len(next(iter(self.values()), ()))} frames>"

    def __missing__(self, name: str) -> Array:
        raise ParameterError(unknown("parameter", str(name), NAMES))


def frame_count(duration: float, fps: Fraction) -> int:
    """Return the number of frames at k/fps, k = 0 … round(duration·fps).

    Raises InputError if they are more than `MOST_FRAMES`.
    """
    count = round(duration * fps) + 1
    if count > MOST_FRAMES:
        rate = f"{duration:g} s at {float(fps):g} frames a second are {frames_text(count)}"
        raise InputError(f"{rate}; expected at most {MOST_FRAMES:,}: a lower fps, or a shorter performance")
    return count


def frames_text(count: int) -> str:
    """Return how many frames there are and how much memory their curves take, in words."""
    return f"{count:,} frames ({count * len(NAMES) * 8 / 1e6:,.0f} MB of curves)"


def announced(score: Score, fps: Fraction, progress: Progress) -> Score:
    """Return a score, and say beforehand how many frames it will have if they are many."""
    count = frame_count(score.duration, fps)
    if count > MANY_FRAMES:
        progress(f"Combining {frames_text(count)} …")
    return score


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

    def __repr__(self) -> str:
        """Return one line: how long it is, and how many frames it has."""
        return f"<Performance of {self.duration:.2f} s, {len(self.values)} frames at {self.fps} per second>"

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
    def curves(self) -> CurvesByName:
        """All curves by name, in the table's order."""
        return CurvesByName((name, self.values[:, i]) for i, name in enumerate(NAMES))
