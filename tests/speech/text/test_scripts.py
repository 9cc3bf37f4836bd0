"""Words in other scripts: another voice reads them, or a warning names them."""

from __future__ import annotations

import sys

import pytest

from risorius.errors import SpeechError, SpeechWarning
from risorius.speech.synthesis import synthesize_line
from risorius.speech.text.scripts import foreign_scripts


def spans(text: str, code: str) -> list[tuple[str, str]]:
    return [(text[s.start : s.end], s.language) for s in foreign_scripts(text, code)]


@pytest.mark.parametrize(
    ("text", "code", "found"),
    [
        ("I say 你好 now", "en-us", [("你好", "cmn")]),
        ("東京です", "en-us", [("東京です", "ja")]),
        ("我吃ラーメン。", "cmn", [("ラーメン", "ja")]),
        ("東京です", "ja", []),
        ("Привет, 안녕", "de", [("Привет", "ru"), ("안녕", "ko")]),
        ("Привет", "ru", []),
        ("α and αβγ", "en-us", [("αβγ", "el")]),
        ("ไทย", "en-us", [("ไทย", "")]),
        ("ไทย 你好", "th", []),
        ("Ærø, naïve", "en-us", []),
    ],
)
def test_who_reads_another_script(text: str, code: str, found: list[tuple[str, str]]) -> None:
    assert spans(text, code) == found


@pytest.mark.parametrize(
    ("text", "code"), [("我吃ラーメン。", "cmn"), ("I say 你好.", "en-us"), ("Ich sage Привет.", "de")]
)
def test_no_letter_is_spelled(text: str, code: str) -> None:
    utterance = synthesize_line(text, language=code)
    assert utterance.duration < 0.45 * sum(c.isalnum() for c in text)


def test_a_word_that_cannot_be_read_is_named() -> None:
    with pytest.warns(SpeechWarning, match="this voice cannot read 'ไทย'"):
        synthesize_line("I say ไทย.")


def test_japanese_with_kanji_has_its_readings() -> None:
    utterance = synthesize_line("明日は2人で東京に行きます。", language="ja")
    assert [w.text for w in utterance.words] == ["明日", "は", "2人", "で", "東京", "に", "行き", "ます"]
    phones = [
        "".join(p.symbol for p in utterance.phones[w.first_phone : w.last_phone]) for w in utterance.words
    ]
    assert phones[1].startswith("w")
    assert phones[2].startswith("ɸ")
    assert "tʃ" not in "".join(phones)


def test_japanese_with_kanji_names_the_extra_that_it_needs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyopenjtalk", None)
    with pytest.raises(SpeechError, match=r"pip install 'risorius\[ja\]'"):
        synthesize_line("宅地域。", language="ja")
    assert synthesize_line("こんにちは。", language="ja").words


def test_nothing_of_the_extra_is_loaded_for_other_texts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyopenjtalk", None)
    assert synthesize_line("Hello.").words
