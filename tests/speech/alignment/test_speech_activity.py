"""Long silences and noise are left out of what the aligner hears, and times are put back."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

from risorius.core.arrays import Array
from risorius.core.speech.audio import Audio, AudioWriter
from risorius.core.speech.utterance import Utterance
from risorius.speech.alignment import align
from risorius.speech.alignment.decoder import AlignedPhone
from risorius.speech.alignment.speech_activity import PAD, Condensed, condensed, sounding
from risorius.speech.resampled import Resampled

FULL = 32_767.0
Gap = tuple[float, float]


def audio_of(samples: Array, rate: int) -> Audio:
    with AudioWriter(rate) as writer:
        writer.append(np.clip(np.round(samples), -FULL, FULL).astype(np.int16))
        return writer.finish()


def noise(kind: str, count: int, rate: int) -> Array:
    """Return noise of a kind: "room" falls with frequency and hums, and of a level in dB of full scale."""
    name, level = kind.split()
    sound = np.random.default_rng(3).normal(size=count)
    if name == "room":
        hertz = np.fft.rfftfreq(count, 1.0 / rate)
        sound = np.fft.irfft(np.fft.rfft(sound) / np.maximum(hertz, 40.0) ** 0.8, count)
        sound += sound.std() * np.sin(2.0 * np.pi * 50.0 * np.arange(count) / rate)
    return np.asarray(sound / sound.std() * FULL * 10.0 ** (float(level) / 20.0))


def with_silence(spoken: Utterance, gaps: list[Gap], kind: str = "") -> tuple[Audio, list[float]]:
    """Return a line with silence put in: (word before which it is, seconds); and where each word begins."""
    rate, samples = spoken.audio.sample_rate, spoken.audio.read().astype(np.float64)
    starts = [word.start for word in spoken.words]
    pieces, reached = [], 0
    for word, seconds in gaps:
        at = samples.size
        if word < len(spoken.words):
            before = spoken.words[int(word) - 1].end if word else 0.0
            at = round((0.5 * (before + spoken.words[int(word)].start) if word else 0.0) * rate)
        pieces += [samples[reached:at], np.zeros(round(seconds * rate))]
        reached = at
        starts = [s + seconds if index >= word else s for index, s in enumerate(starts)]
    whole = np.concatenate([*pieces, samples[reached:]])
    return audio_of(whole + noise(kind, len(whole), rate) if kind else whole, rate), starts


@pytest.mark.parametrize(
    ("gaps", "kind"),
    [
        ([(0, 6.0)], ""),
        ([(0, 60.0)], "white -54"),
        ([(10, 8.0)], ""),
        ([(10, 60.0)], "white -54"),
        ([(4, 6.0)], "white -60"),
        ([(4, 12.0), (7, 6.0)], "room -50"),
        ([(0, 30.0), (4, 2.0), (10, 30.0)], "white -40"),
        ([(0, 20.0), (10, 20.0)], "room -40"),
    ],
)
def test_words_are_found_in_spite_of_silence(spoken: Utterance, gaps: list[Gap], kind: str) -> None:
    audio, starts = with_silence(spoken, gaps, kind)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = align(audio, spoken.text)
    away = np.abs(np.array([word.start for word in found.words]) - starts)
    assert np.median(away) < 0.02
    assert away.max() < 0.07
    assert found.phones[0].start == 0.0
    assert found.phones[-1].end == pytest.approx(audio.duration)


def test_a_recording_without_long_silence_is_itself(spoken: Utterance) -> None:
    assert condensed(Resampled(spoken.audio)).audio is spoken.audio


def test_silence_is_left_out_but_for_what_is_beside_sounds(spoken: Utterance) -> None:
    audio, _ = with_silence(spoken, [(0, 20.0), (10, 30.0)], "white -60")
    sound = condensed(Resampled(audio))
    assert sound.audio.duration < spoken.duration + 2 * PAD
    assert sound.time(0.0) == pytest.approx(20.0 + spoken.words[0].start - PAD, abs=0.1)
    assert sound.time(sound.audio.duration) == pytest.approx(sound.pieces[-1][1])


def test_a_long_steady_vowel_sounds() -> None:
    levels = np.concatenate([np.full(300, 20.0), np.full(600, 60.0), np.full(300, 20.0)])
    sounds = sounding(levels)
    assert sounds[305:895].all()
    assert not sounds[:290].any()


def test_noise_alone_is_whole() -> None:
    audio = audio_of(noise("white -40", 80_000, 16_000), 16_000)
    assert condensed(Resampled(audio)).pieces == ((0.0, 5.0),)


def test_phones_are_put_back_and_none_lasts_over_what_was_left_out() -> None:
    sound = Condensed(audio_of(np.zeros(16_000), 16_000), ((2.0, 2.5), (9.0, 9.5)), 12.0)
    phones = [
        AlignedPhone("", 0.0, 0.2, -1, 0.0),
        AlignedPhone("AA", 0.2, 0.6, 0, 0.0),
        AlignedPhone("K", 0.6, 0.8, 1, 0.0),
        AlignedPhone("", 0.8, 1.0, -1, 0.0),
    ]
    placed = sound.placed(phones)
    assert [(p.symbol, round(p.start, 3), round(p.end, 3)) for p in placed] == [
        ("", 0.0, 2.2),
        ("AA", 2.2, 2.5),
        ("", 2.5, 9.1),
        ("K", 9.1, 9.3),
        ("", 9.3, 12.0),
    ]


def test_a_word_that_begins_a_piece_is_no_longer_than_there() -> None:
    sound = Condensed(audio_of(np.zeros(8_000), 16_000), ((2.0, 2.5),), 3.0)
    placed = sound.placed([AlignedPhone("AA", 0.0, 0.5, 0, 0.0)])
    assert [(p.symbol, p.start, p.end) for p in placed] == [("", 0.0, 2.0), ("AA", 2.0, 2.5), ("", 2.5, 3.0)]
