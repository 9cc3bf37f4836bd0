"""Two words halve the silence between a hiss and a voiced sound, and no other silence."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.arrays import Array
from risorius.speech.alignment.decoder import AlignedPhone
from risorius.speech.alignment.hiss_ends import hiss_ends
from risorius.speech.alignment.spectra import band_levels
from risorius.speech.resampled import RATE

EDGE = 0.3
T = np.arange(round(0.6 * RATE)) / RATE
VOICE = sum(4_000 / k * np.sin(2 * np.pi * 120 * k * T) for k in range(1, 12))
HISS = 1_500 * np.diff(np.random.default_rng(1).normal(size=len(T) + 1))


def with_silence(length: float) -> Array:
    """Return a hiss, a silence of `length` seconds, and from EDGE on a voice."""
    sound = np.where(T < EDGE, HISS, VOICE)
    sound[(EDGE - length <= T) & (T < EDGE)] = 0.0
    return sound


def edge(sound: Array, symbols: tuple[str, str], words: tuple[int, int] = (0, 1)) -> float:
    spans = zip(symbols, ((0.1, EDGE), (EDGE, 0.6)), words, strict=True)
    phones = [AlignedPhone(symbol, *span, word, -10.0) for symbol, span, word in spans]
    (placed,) = hiss_ends(band_levels(sound), phones, np.array([EDGE]))
    return float(placed)


@pytest.mark.parametrize("symbols", [("SH", "W"), ("S", "W"), ("Z", "M"), ("S", "N"), ("F", "L")])
def test_two_words_halve_the_silence_after_a_hiss(symbols: tuple[str, str]) -> None:
    assert edge(with_silence(0.06), symbols) == pytest.approx(EDGE - 0.03, abs=0.006)


@pytest.mark.parametrize(
    ("length", "symbols", "words"),
    [
        (0.0, ("SH", "W"), (0, 1)),
        (0.015, ("SH", "W"), (0, 1)),
        (0.06, ("S", "M"), (0, 0)),
        (0.06, ("S", "T"), (0, 1)),
        (0.06, ("T", "W"), (0, 1)),
        (0.06, ("", "W"), (-1, 0)),
    ],
    ids=["none", "short", "in a word", "a closure", "after a stop", "after silence"],
)
def test_other_edges_stay(length: float, symbols: tuple[str, str], words: tuple[int, int]) -> None:
    assert edge(with_silence(length), symbols, words) == EDGE
