"""Fundamental frequency by YIN, its path through the frames chosen as a whole.

De Cheveigné and Kawahara (2002): per frame the difference function d(τ) of the sound and itself τ later, made
independent of loudness by its running mean; periods are its minima, their depth the aperiodicity. Up to five
minima per frame are kept and one path is found through them and "unvoiced" by dynamic programming, as in
Boersma (1993), which is what spares the octave errors of frame-by-frame choice. A second path keeps to the
speaker's range, from what was heard before and from the first path (De Looze and Hirst 2008).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

from ...core.arrays import Array, BoolArray, Int64Array
from ..filters import low_pass
from ..resampled import RATE, Resampled
from .running import RunningRange, unknown_speaker

# Seconds between frames, and of each frame's window.
STEP, WINDOW = 0.01, 0.03
LOWEST, HIGHEST = 60.0, 500.0
CANDIDATES = 5
# Costs: of a frame without voice, per octave of a jump, of a change of voicing, and per octave below HIGHEST
# (the period's multiples are minima nearly as deep).
UNVOICED_COST, JUMP_COST, VOICING_COST, LOW_COST = 0.55, 1.2, 0.1, 0.03
# Frames so far (dB) below the loud ones have no voice.
SILENCE_BELOW = 35.0
# The speaker's range: shares of the quartiles of what the first path found, and the cost outside of it.
FLOOR_OF_LOWER, CEILING_OF_UPPER, OUTSIDE_COST = 0.72, 1.9, 0.15
_CHUNK_SECONDS = 10.0
_NOISE = 2_500.0  # Hz above which speech is mostly noise


@dataclass(frozen=True, slots=True)
class Pitch:
    """F0 in Hz every STEP seconds from frame `first` on, frame k at k STEP; NaN without voice; (frames,)."""

    hertz: Array
    first: int = 0

    @property
    def times(self) -> Array:
        """Seconds."""
        return np.asarray(STEP * np.arange(self.first, self.first + len(self.hertz)), dtype=np.float64)

    @property
    def semitones(self) -> Array:
        """F0 in semitones above 1 Hz, NaN in unvoiced frames."""
        return np.asarray(12.0 * np.log2(self.hertz))


class _Candidates(NamedTuple):
    """Per frame: frequencies in Hz and their aperiodicities, (frames, CANDIDATES), NaN and inf where none."""

    hertz: Array
    aperiodicity: Array


def measure_pitch(
    resampled: Resampled, start: float, end: float, speaker: RunningRange | None = None
) -> Pitch:
    """Return the pitch in [start, end] seconds of a recording, read chunk by chunk.

    `speaker`: the range of the voice as far as it was heard before.
    """
    speaker = speaker or unknown_speaker().range
    frames = range(round(start / STEP), round(end / STEP) + 1)
    per_chunk = round(_CHUNK_SECONDS / STEP)
    chunks = [_candidates(resampled, frames[at : at + per_chunk]) for at in range(0, len(frames), per_chunk)]
    candidates = _Candidates(*(np.concatenate(parts) for parts in zip(*chunks, strict=True)))
    quiet = _quiet(resampled, frames, end)
    hertz = _path(candidates, quiet, LOWEST, HIGHEST)
    voiced = hertz[np.isfinite(hertz)]
    if len(voiced):
        pitch_range = speaker.with_frames(12.0 * np.log2(voiced))
        low, high = 2.0 ** (pitch_range.lower / 12.0), 2.0 ** (pitch_range.upper / 12.0)
        hertz = _path(candidates, quiet, FLOOR_OF_LOWER * low, CEILING_OF_UPPER * high)
    return Pitch(_centred(hertz), frames.start)


def _candidates(resampled: Resampled, frames: range) -> _Candidates:
    longest = int(RATE / LOWEST) + 2
    size = round(WINDOW * RATE)
    # Frame k looks at a window and its copies up to `longest` later, all of it around k STEP.
    lead = 0.5 * (size + longest) / RATE
    start, end = frames.start * STEP - lead, (frames.stop - 1) * STEP + lead
    low_pass = _low_pass()
    half = len(low_pass) // 2
    sound = np.convolve(resampled.read(start - half / RATE, end + (1 + half) / RATE), low_pass, mode="valid")
    hop = round(STEP * RATE)
    rows = np.lib.stride_tricks.sliding_window_view(
        _long_enough(sound, frames, hop, size + longest), size + longest
    )
    normalised = _normalised_difference(rows[::hop][: len(frames)], size, longest)
    return _minima(normalised)


def _long_enough(sound: Array, frames: range, hop: int, width: int) -> Array:
    missing = (len(frames) - 1) * hop + width - len(sound)
    return np.pad(sound, (0, max(missing, 0)))


def _normalised_difference(rows: Array, size: int, longest: int) -> Array:
    """Return d'(τ) for τ = 0 … longest - 1, shape (frames, longest)."""
    rows = rows - rows.mean(axis=1, keepdims=True)
    # Lags below `longest` stay within a row, so that none wraps around.
    length = 1 << int(np.ceil(np.log2(rows.shape[1])))
    spectra = np.conj(np.fft.rfft(rows[:, :size], length)) * np.fft.rfft(rows, length)
    products = np.fft.irfft(spectra, length)[:, :longest]
    sums = np.concatenate((np.zeros((len(rows), 1)), np.cumsum(rows**2, axis=1)), axis=1)
    energy = sums[:, size : size + longest] - sums[:, :longest]
    difference = np.maximum(energy[:, :1] + energy - 2.0 * products, 0.0)
    mean = np.cumsum(difference[:, 1:], axis=1) / np.arange(1, longest)
    normalised = np.ones_like(difference)
    normalised[:, 1:] = difference[:, 1:] / (mean + 1e-9)
    return normalised


@cache
def _low_pass() -> Array:
    taps = low_pass(np.hamming(31), _NOISE / (0.5 * RATE))
    taps.setflags(write=False)
    return taps


def _minima(normalised: Array) -> _Candidates:
    """Return the deepest minima of each row between the shortest and longest period, placed by parabolas."""
    shortest = int(RATE / HIGHEST)
    inner = normalised[:, shortest:-1]
    dips = (inner < normalised[:, shortest - 1 : -2]) & (inner <= normalised[:, shortest + 1 :])
    depths = np.where(dips, inner, np.inf)
    order = np.argsort(depths, axis=1, kind="stable")[:, :CANDIDATES]
    aperiodicity = np.take_along_axis(depths, order, axis=1)
    lags = order + shortest
    before, at, after = (np.take_along_axis(normalised, lags + shift, axis=1) for shift in (-1, 0, 1))
    curvature = before - 2.0 * at + after
    with np.errstate(divide="ignore", invalid="ignore"):
        shift = np.where(curvature > 0.0, 0.5 * (before - after) / curvature, 0.0)
        hertz = np.where(np.isfinite(aperiodicity), RATE / (lags + shift), np.nan)
    return _Candidates(hertz, aperiodicity)


def _centred(hertz: Array) -> Array:
    """Return the F0 at the frames' times: the compared samples lie earlier, the shorter the period."""
    longest = int(RATE / LOWEST) + 2
    times = STEP * np.arange(len(hertz)) - 0.5 * (longest / RATE - 1.0 / hertz)
    centred = hertz.copy()
    voiced = np.concatenate(([False], np.isfinite(hertz), [False]))
    for first, last in np.flatnonzero(np.diff(voiced)).reshape(-1, 2):
        centred[first:last] = np.interp(STEP * np.arange(first, last), times[first:last], hertz[first:last])
    return centred


def _quiet(resampled: Resampled, frames: range, end: float) -> BoolArray:
    """Return which frames are too quiet to be voiced beside the loud ones up to `end` seconds."""
    levels = np.asarray(resampled.levels, dtype=np.float64)
    # A window of three: a frame lies at the edge of two.
    around = np.clip(np.arange(frames.start - 1, frames.stop + 1), 0, len(levels) - 1)
    smooth = np.convolve(levels[around], np.full(3, 1 / 3), mode="valid")
    return np.asarray(smooth < resampled.loud_level(end) - SILENCE_BELOW)


def _path(candidates: _Candidates, quiet: BoolArray, floor: float, ceiling: float) -> Array:
    """Return the F0 of each frame on the cheapest path, NaN if it is unvoiced."""
    octaves = np.log2(np.where(np.isfinite(candidates.hertz), candidates.hertz, HIGHEST))
    cost = candidates.aperiodicity + LOW_COST * (np.log2(HIGHEST) - octaves)
    outside = np.maximum(np.log2(floor) - octaves, 0.0) + np.maximum(octaves - np.log2(ceiling), 0.0)
    cost = np.where(quiet[:, None], np.inf, cost + np.where(outside > 0.0, OUTSIDE_COST + outside, 0.0))
    cost = np.concatenate((cost, np.full((len(cost), 1), UNVOICED_COST)), axis=1)
    chosen = _cheapest(octaves, cost)
    hertz = np.concatenate((candidates.hertz, np.full((len(cost), 1), np.nan)), axis=1)
    return np.asarray(np.take_along_axis(hertz, chosen[:, None], axis=1)[:, 0])


def _cheapest(octaves: Array, cost: Array) -> Int64Array:
    """Return the column of each row on the cheapest path; the last column is "unvoiced"."""
    states = cost.shape[1]
    jumps = np.full((states, states), VOICING_COST)
    jumps[-1, -1] = 0.0
    total = cost[0]
    came_from = np.zeros(cost.shape, dtype=np.int64)
    for frame in range(1, len(cost)):
        jumps[:-1, :-1] = JUMP_COST * np.abs(octaves[frame - 1][:, None] - octaves[frame])
        reached = total[:, None] + jumps
        came_from[frame] = reached.argmin(axis=0)
        total = reached.min(axis=0) + cost[frame]
    chosen = np.empty(len(cost), dtype=np.int64)
    chosen[-1] = int(total.argmin())
    for frame in range(len(cost) - 1, 0, -1):
        chosen[frame - 1] = came_from[frame, chosen[frame]]
    return chosen
