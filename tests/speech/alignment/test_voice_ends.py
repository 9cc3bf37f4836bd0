"""Voiced sounds end before a silence where the voice does; two words share a sound in halves."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.speech.alignment.decoder import AlignedPhone
from risorius.speech.alignment.spectra import band_levels
from risorius.speech.alignment.voice_ends import shared_sounds, voice_ends
from risorius.speech.resampled import RATE

STOPS, DECODED = 0.4, 0.5
T = np.arange(round(0.8 * RATE)) / RATE
VOICE = sum(4_000 / k * np.sin(2 * np.pi * 120 * k * T) for k in range(1, 12))
BREATH = 300 * np.diff(np.random.default_rng(1).normal(size=len(T) + 1))
SOUND = np.where(T < STOPS, VOICE, BREATH)


def phones(*symbols: str, words: tuple[int, ...] | None = None) -> tuple[list[AlignedPhone], np.ndarray]:
    """Return phones, the last two of which meet where the decoder ends the word, and their edges."""
    edges = np.array([0.1, 0.25, DECODED])
    bounds = [0.0, *edges, 0.8]
    owners = words or tuple(0 if symbol else -1 for symbol in symbols)
    spans = zip(symbols, bounds, bounds[1:], owners, strict=False)
    return [AlignedPhone(s, a, b, word, -10.0) for s, a, b, word in spans], edges


@pytest.mark.parametrize("last", ["N", "M", "L", "R", "AH"])
def test_a_voiced_sound_ends_with_the_voice(last: str) -> None:
    spoken, edges = phones("", "EH", last, "")
    assert voice_ends(band_levels(SOUND), spoken, edges)[-1] == pytest.approx(STOPS, abs=0.01)


@pytest.mark.parametrize("symbols", [("", "EH", "S", ""), ("", "EH", "T", ""), ("", "EH", "N", "IY")])
def test_hisses_stops_and_sounds_inside_speech_keep_their_ends(symbols: tuple[str, ...]) -> None:
    spoken, edges = phones(*symbols)
    assert voice_ends(band_levels(SOUND), spoken, edges).tolist() == edges.tolist()


def test_a_sound_keeps_its_first_half() -> None:
    spoken, edges = phones("", "EH", "N", "")
    quiet = np.where(T < 0.27, VOICE, BREATH)
    assert voice_ends(band_levels(quiet), spoken, edges)[-1] == pytest.approx(0.375, abs=0.005)


@pytest.mark.parametrize(
    ("one", "two", "after"), [("S", "S", "AO"), ("Z", "S", "IY"), ("M", "M", "OY"), ("IY", "IY", "P")]
)
def test_two_words_share_a_lasting_sound_in_halves(one: str, two: str, after: str) -> None:
    spoken, edges = phones("IH", one, two, after, words=(0, 0, 1, 1))
    assert shared_sounds(spoken, edges).tolist() == pytest.approx([0.1, 0.3, DECODED])


@pytest.mark.parametrize(("one", "after"), [("S", "K"), ("Z", "T"), ("S", "W")])
def test_before_a_consonant_the_first_word_has_the_shared_sound(one: str, after: str) -> None:
    spoken, edges = phones("IH", one, "S", after, words=(0, 0, 1, 1))
    assert shared_sounds(spoken, edges).tolist() == pytest.approx([0.1, DECODED, DECODED])


@pytest.mark.parametrize(
    ("one", "two", "words"), [("T", "T", (0, 0, 1, 1)), ("S", "Z", (0, 0, 0, 0)), ("M", "N", (0, 0, 1, 1))]
)
def test_other_edges_stay(one: str, two: str, words: tuple[int, ...]) -> None:
    spoken, edges = phones("IH", one, two, "K", words=words)
    assert shared_sounds(spoken, edges).tolist() == edges.tolist()


def test_what_lies_behind_the_end_of_the_sound_keeps_its_place() -> None:
    spoken, edges = phones("", "EH", "N", "")
    short = band_levels(SOUND[: round(0.09 * RATE)])
    assert voice_ends(short, spoken, edges).tolist() == edges.tolist()
