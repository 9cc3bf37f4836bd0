"""Accents and boundaries on voices whose tune is drawn by hand."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.speech.audio import AudioWriter
from risorius.core.speech.tobi import BOUNDARY_TONES, PITCH_ACCENTS
from risorius.core.speech.utterance import Phone, Syllable, Utterance, Word
from risorius.languages import language_of
from risorius.speech import synthesize_line
from risorius.speech.prosody import measured, speech_rate
from risorius.speech.structure.pauses import find_pauses
from risorius.speech.structure.syllables import syllabify

RATE = 16_000
SECONDS = 0.2
WORDS = ("the", "a", "map", "the", "beam", "of", "mine")


def sung(
    points: list[tuple[float, float]], loud: int = -1, long: int = -1, words: tuple[str, ...] = WORDS
) -> Utterance:
    """Return words of one syllable (M AA), their pitch in Hz through `points` (syllables from 0 on, Hz)."""
    edges = np.cumsum([0.3, *(SECONDS * (2 if n == long else 1) for n in range(len(words)))])
    end = edges[-1] + 0.4
    t = np.arange(round(end * RATE)) / RATE
    at = np.interp([x for x, _ in points], np.arange(len(edges)), edges)
    hertz = np.interp(t, at, [y for _, y in points])
    phase = 2 * np.pi * np.cumsum(hertz) / RATE
    sound = sum(np.cos(k * phase) / k for k in range(1, 15)) * 3_000
    sound = np.where((t > edges[0]) & (t < edges[-1]), sound, 0.0)
    if loud >= 0:
        sound = np.where((t > edges[loud]) & (t < edges[loud + 1]), 2.2 * sound, sound)
    with AudioWriter(RATE) as writer:
        writer.append(np.round(sound).astype(np.int16))
        audio = writer.finish()
    phones, said = [Phone("", 0.0, edges[0])], []
    text = " ".join(words)
    for n, word in enumerate(words):
        middle = edges[n] + 0.06
        stress = 0 if word in ("the", "a", "of") else 2
        phones += [Phone("M", edges[n], middle, -1, n), Phone("AA", middle, edges[n + 1], stress, n)]
        start = len(" ".join(words[:n])) + (n > 0)
        said.append(Word(word, edges[n], edges[n + 1], 2 * n + 1, 2 * n + 3, start, start + len(word)))
    phones.append(Phone("", edges[-1], audio.duration))
    english = language_of("en")
    syllables = syllabify(phones, said, english)
    return Utterance(
        text,
        "en-us",
        audio,
        tuple(phones),
        tuple(said),
        syllables,
        find_pauses(text, phones, said, english),
    )


FLAT = [(0.0, 120.0), (7.0, 110.0)]


def test_labels_are_tobis_and_confidences_shares() -> None:
    found = measured(sung([(0, 120), (2, 100), (2.6, 170), (3.4, 105), (4.5, 150), (6, 100), (7, 90)]))
    assert found.accents
    assert {a.label for a in found.accents} <= {*PITCH_ACCENTS, "*"}
    assert {b.label for b in found.boundaries} <= {*BOUNDARY_TONES, "%"}
    assert all(0.0 < x.confidence <= 1.0 for x in (*found.accents, *found.boundaries))
    assert [a.nuclear for a in found.accents] == [False] * (len(found.accents) - 1) + [True]


def test_a_steep_rise_is_an_l_h_star_on_its_word() -> None:
    found = measured(sung([(0, 100), (2, 98), (2.8, 170), (3.6, 100), (7, 95)]))
    accent = max(found.accents, key=lambda a: a.confidence)
    assert (accent.word, accent.label) == (2, "L+H*")


def test_a_valley_is_an_l_star() -> None:
    found = measured(sung([(0, 170), (3.9, 165), (4.2, 112), (4.9, 110), (5.6, 160), (7, 165)]))
    assert [a.label for a in found.accents if a.word == 4] in (["L*"], ["L*+H"])


@pytest.mark.parametrize(
    ("end", "label"),
    [
        ([(5.5, 120.0), (6.2, 100.0), (7.0, 80.0)], "L-L%"),
        ([(5.5, 120.0), (6.3, 85.0), (6.5, 85.0), (7.0, 130.0)], "L-H%"),
        ([(5.5, 150.0), (6.3, 150.0), (7.0, 220.0)], "H-H%"),
        ([(5.5, 100.0), (6.2, 160.0), (7.0, 160.0)], "H-L%"),
    ],
)
def test_boundary_tones(end: list[tuple[float, float]], label: str) -> None:
    found = measured(sung([(0.0, 120.0), (2.4, 140.0), (3.5, 100.0), *end]))
    assert (found.boundaries[-1].label, found.boundaries[-1].word) == (label, 6)


def test_loud_and_long_syllables_stand_out() -> None:
    loud, long = measured(sung(FLAT, loud=4)).syllables, measured(sung(FLAT, long=4)).syllables
    others = [index for index in range(len(WORDS)) if index != 4]
    assert loud[4].loudness > max(loud[index].loudness for index in others) + 4.0
    assert loud[4].prominence > max(loud[index].prominence for index in others) + 0.5
    assert long[4].prominence > max(long[index].prominence for index in others) + 0.5


def test_prominences_are_standard_deviations() -> None:
    text = "I like it very much. My baby brother put the big map by the beam. Nobody drank it. " * 4
    values = np.array([s.prominence for s in measured(synthesize_line(text)).syllables])
    assert values.mean() == pytest.approx(0.0, abs=0.1)
    assert values.std() == pytest.approx(1.0, abs=0.1)


def test_a_voice_that_hardly_varies_has_little_prominence() -> None:
    assert max(abs(s.prominence) for s in measured(sung(FLAT)).syllables) < 0.5


def test_what_is_not_asked_for_stays() -> None:
    said = sung(FLAT)
    assert measured(said, accents=False, boundaries=False).accents == said.accents
    assert measured(said, boundaries=False).boundaries == ()


def test_rate_counts_syllables_per_second_of_speech() -> None:
    assert speech_rate(sung(FLAT)) == pytest.approx(1 / SECONDS)
    assert (
        speech_rate(Utterance("", "en", sung(FLAT).audio, (Phone("", 0.0, sung(FLAT).duration),), ())) == 0.0
    )


def test_an_utterance_of_one_syllable_or_none_is_measured() -> None:
    one = measured(sung([(0, 120.0), (1, 100.0)], words=("beam",)))
    assert len(one.accents) <= 1
    assert isinstance(one.syllables[0], Syllable)
