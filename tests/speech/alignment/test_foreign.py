"""Recordings in other languages than the model's: aligned by the nearest phones, told in their own."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest

import risorius
from risorius.core.speech.utterance import SILENCE, Word
from risorius.errors import InputError, UnusedSettingError
from risorius.speech.alignment import align
from risorius.speech.alignment.aligner import owned
from risorius.speech.alignment.decoder import AlignedPhone
from risorius.speech.alignment.lexicon import OwnPhone, ScriptWord, read_transcript
from risorius.speech.engines.voices import find_voice
from risorius.speech.synthesis import synthesize_line

SENTENCES = {
    "de": "Ich habe gestern ein Buch gelesen.",
    "fr": "Je voudrais un petit pain au chocolat.",
    "es": "Mañana vamos a la playa con los niños.",
    "it": "Domani andiamo al mare con i bambini.",
    "nl": "Morgen gaan we met de trein naar Amsterdam.",
    "pt": "Amanhã vamos à praia com as crianças.",
}
EVERY = [pytest.param(code, marks=[pytest.mark.full] * (code not in ("de", "pt"))) for code in SENTENCES]


def symbols(utterance):  # type: ignore[no-untyped-def]
    return [phone.symbol for phone in utterance.phones if phone.symbol]


@pytest.mark.parametrize("language", EVERY)
def test_words_and_phones_are_where_the_voice_says_them(language: str) -> None:
    voice = f"{find_voice(None, language).name}+f3"
    said = synthesize_line(SENTENCES[language], voice=voice, rate=150, lead=0.3, tail=0.3)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = align(said.audio, SENTENCES[language], language)
    assert found.language.split("-")[0] == language
    assert symbols(found) == symbols(said)
    away = [abs(a.start - b.start) for a, b in zip(found.words, said.words, strict=True)]
    assert np.median(away) < 0.04
    assert found.accents
    others = [sentence for code, sentence in SENTENCES.items() if code != language]
    with pytest.raises(InputError, match="does not fit the recording"):
        align(said.audio, others[0], language)


def test_what_the_model_has_in_two_parts_is_one_phone() -> None:
    word = Word("x", 0.0, 0.0, 0, 0, 0, 1)
    words = [ScriptWord(word, (("T", "S", "AH"),), (2,), (OwnPhone("ts", 2), OwnPhone("ə", 1)))] * 2
    one = [("T", 0.0), ("S", 0.1), ("AH", 0.2)]
    phones = [AlignedPhone(s, t + w, t + w + 0.1, w, -10.0) for w in (0, 1) for s, t in one]
    phones.insert(3, AlignedPhone(SILENCE, 0.3, 1.0, -1, -5.0))
    found = owned(phones, words)
    assert [(p.symbol, round(p.start, 1), round(p.end, 1), p.word) for p in found] == [
        ("ts", 0.0, 0.2, 0), ("ə", 0.2, 0.3, 0), ("", 0.3, 1.0, -1), ("ts", 1.0, 1.2, 1), ("ə", 1.2, 1.3, 1),
    ]  # fmt: skip


def test_every_phone_of_a_word_has_parts_and_english_keeps_its_readings() -> None:
    _, words = read_transcript("Größe, Chef", "de")
    for entry in words:
        assert sum(part.parts for part in entry.own) == len(entry.readings[0])
    _, (word,) = read_transcript("either", "en-gb")
    assert not word.own
    assert len(word.readings) > 1


def test_a_language_needs_words(tmp_path: Path) -> None:
    with pytest.raises(UnusedSettingError, match="recognized as English only"):
        risorius.align(tmp_path / "x.wav", language="de")
    with pytest.raises(UnusedSettingError, match="recognized as English only"):
        risorius.speak(audio=tmp_path / "x.wav", settings=risorius.Settings(language="de"))
    with pytest.raises(UnusedSettingError, match="language has no effect: the voice is recorded"):
        risorius.speak("x.TextGrid", audio=tmp_path / "x.wav", settings=risorius.Settings(language="de"))
