"""Tones from a transcription, given to the sounds of a rendition."""

from __future__ import annotations

import pytest

from risorius.languages import language_of
from risorius.speech.engines.espeak import EspeakEngine
from risorius.speech.engines.espeak_tones import tones_of
from risorius.speech.synthesis import synthesize_line

TONES = {"55": "˥", "35": "˧˥", "11": ""}


@pytest.mark.parametrize(
    ("names", "transcribed", "expected"),
    [
        ("", "", []),
        ("m 'A _| m A _:", "m 'A55 _| m A11", ["", "˥", "", "", "", ""]),
        # A word of another language has no tones; sounds that differ, neither.
        ("m A (en) oU (cmn) m A", "m A35 (en) 'oU (cmn) m A55", ["", "˧˥", "", "", "", "", "˥"]),
        ("m A n i", "m A55 n y35", ["", "˥", "", ""]),
        ("m A", "", ["", ""]),
    ],
)
def test_tones_go_to_the_sounds_that_are_the_same(names: str, transcribed: str, expected: list[str]) -> None:
    assert tones_of(names.split(), transcribed.split(), TONES) == expected


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [
        ("cmn", "妈麻马骂吗。", ["˥", "˧˥", "˨˩˦", "˥˩", ""]),
        ("yue", "詩史試時市事。", ["˥", "˧˥", "˧", "˨˩", "˩˧", "˨"]),
        ("vi", "ma mà má mả mã mạ", ["", "˨˩", "˧˥", "˧˩˨", "˧ˀ˥", "˨˩ˀ"]),
        ("de", "Mama.", ["", ""]),
    ],
)
def test_the_voices_tones(language: str, text: str, expected: list[str], engine: EspeakEngine) -> None:
    said = synthesize_line(text, language=language, engine=engine)
    assert [phone.tone for phone in said.phones if phone.stress >= 0] == expected
    assert {phone.tone for phone in said.phones if phone.stress < 0} == {""}


@pytest.mark.parametrize("language", ["cmn", "yue", "vi"])
def test_letters_of_tones_are_no_phones(language: str) -> None:
    letters = "".join(language_of(language).tone_letters.values())
    assert set(letters) <= set("˥˦˧˨˩ˀ")
