"""A word that begins with a vowel begins where the voice stops before it, and only there."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from risorius.core.arrays import Array
from risorius.core.speech.audio import AudioWriter
from risorius.speech import synthesize_line
from risorius.speech.alignment.aligner import refined
from risorius.speech.alignment.decoder import AlignedPhone
from risorius.speech.alignment.glottal import glottal_starts
from risorius.speech.alignment.spectra import band_levels
from risorius.speech.resampled import RATE, Resampled

EDGE = 0.3
T = np.arange(round(0.6 * RATE)) / RATE
VOICE = sum(4_000 / k * np.sin(2 * np.pi * 120 * k * T) for k in range(1, 12))
HISS = 1_500 * np.diff(np.random.default_rng(1).normal(size=len(T) + 1))


def glottal(before: Array, length: float, pulses: tuple[float, ...] = ()) -> Array:
    """Return a sound, a glottal stop of `length` seconds, with pulses so long before EDGE, and a voice."""
    sound = np.where(T < EDGE, before, VOICE)
    sound[(EDGE - length <= T) & (T < EDGE)] = 0.0
    for at in pulses:
        sound[round((EDGE - at) * RATE)] = 30_000.0
    return sound


def start(sound: Array, before: str = "N", words: tuple[int, int] = (0, 1), vowel: str = "OY") -> float:
    phones = [
        AlignedPhone(before, 0.1, EDGE, words[0], -10.0),
        AlignedPhone(vowel, EDGE, 0.6, words[1], -10.0),
    ]
    (edge,) = glottal_starts(band_levels(sound), phones, np.array([EDGE]))
    return float(edge)


@pytest.mark.parametrize("pulses", [(), (0.03,), (0.025, 0.045)], ids=["stop", "pulse", "creak"])
@pytest.mark.parametrize(("before", "symbol"), [(VOICE, "N"), (VOICE, "ER"), (HISS, "Z")])
def test_a_glottal_stop_belongs_to_the_vowel_after_it(
    before: Array, symbol: str, pulses: tuple[float, ...]
) -> None:
    assert start(glottal(before, 0.07, pulses), symbol) == pytest.approx(EDGE - 0.07, abs=0.008)


@pytest.mark.parametrize(
    ("sound", "symbol", "words", "vowel"),
    [
        (glottal(VOICE, 0.0), "N", (0, 1), "OY"),
        (glottal(VOICE, 0.015), "N", (0, 1), "OY"),
        (glottal(HISS, 0.0), "Z", (0, 1), "OY"),
        (glottal(0.2 * VOICE, 0.0), "N", (0, 1), "OY"),
        (glottal(VOICE, 0.07), "T", (0, 1), "OY"),
        (glottal(VOICE, 0.07), "N", (0, 0), "OY"),
        (glottal(VOICE, 0.07), "", (-1, 1), "OY"),
        (glottal(VOICE, 0.07), "N", (0, 1), "B"),
        (glottal(0.0 * VOICE, 0.0), "V", (0, 1), "OY"),
    ],
    ids=[
        "none",
        "short",
        "hiss",
        "murmur",
        "after a stop",
        "in a word",
        "after silence",
        "consonant",
        "no voice",
    ],
)
def test_without_a_glottal_stop_an_edge_stays(
    sound: Array, symbol: str, words: tuple[int, int], vowel: str
) -> None:
    assert start(sound, symbol, words, vowel) == EDGE


def test_aligned_words_get_their_glottal_stops() -> None:
    said = synthesize_line("Carry an oily rag.")
    cut, gap = said.words[2].start, 0.07
    samples, rate = said.audio.read(), said.audio.sample_rate
    at = round(cut * rate)
    with AudioWriter(rate) as writer:
        writer.append(np.concatenate([samples[:at], np.zeros(round(gap * rate), np.int16), samples[at:]]))
        audio = writer.finish()
    starts = [0.0, *(phone.start + gap * (phone.start >= cut) for phone in said.phones[1:]), audio.duration]
    phones = [
        AlignedPhone(phone.symbol, a, b, phone.word, -10.0)
        for phone, (a, b) in zip(said.phones, pairwise(starts), strict=True)
    ]
    found = refined(Resampled(audio), phones)
    assert found[said.words[2].first_phone].start == pytest.approx(cut, abs=0.015)
