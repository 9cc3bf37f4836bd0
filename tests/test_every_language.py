"""Every output of speech and curves is written for every language that a voice speaks."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest

import risorius
from risorius.cli.listing import languages as listing
from risorius.errors import SpeechWarning
from risorius.languages import languages
from risorius.ports.formats import FORMATS, Need
from risorius.speech.engines import voices

WITHOUT_FACE = [
    suffix
    for suffix in FORMATS
    if set(FORMATS.get(suffix).needs) <= {Need.SPEECH, Need.MOVEMENTS, Need.CURVES}
]
# Words with all kinds of vowels, and numbers, which every voice reads in its own language.
LATIN = "Ola, meu e zou? 1 2 3 4 5 6 7 8 9 10 11 20 100."
TEXTS = {
    "cmn": "你喜欢喝什么茶？绿色的女士去吃热饭。",
    "yue": "你飲乜嘢茶呀？",
    "ja": "どこですか。わたしはきゃく、びょういん、ふじさん。",
    "ru": "Съешь же ещё этих мягких булок, да выпей чаю?",
    "th": "คุณชื่ออะไร สวัสดีครับ",
    "kl": "Aluu, qanoq ippit?",  # espeak-ng ends at its numbers
    "my": "သင်ဘယ်သွားမလဲ",
}


def spoken() -> list[str]:
    return sorted({code.split("-")[0] for code in voices.languages()})


def _writes(code: str, folder: Path) -> None:
    text = TEXTS.get(code, LATIN)
    take = risorius.speak(text, text=True, settings=risorius.Settings(language=code, fps=5))
    assert take.utterance is not None
    assert len(take.utterance.phones) > 5
    files = [folder / f"x{suffix}" for suffix in WITHOUT_FACE]
    take.write(*files)
    assert [file.name for file in files if not file.stat().st_size] == []


@pytest.mark.parametrize("code", sorted({*languages()} & {*spoken()}))
def test_every_language_with_a_folder_is_written_whole(code: str, tmp_path: Path) -> None:
    _writes(code, tmp_path)


@pytest.mark.full
@pytest.mark.parametrize("code", spoken())
def test_every_language_of_a_voice_is_written_whole(code: str, tmp_path: Path) -> None:
    with warnings.catch_warnings():
        # A sound that no table knows is shown as the nearest, with a warning.
        warnings.simplefilter("ignore", SpeechWarning)
        _writes(code, tmp_path)


def test_voices_without_their_dictionary_are_not_listed() -> None:
    # espeak-ng lists them, but their dictionaries do not come with it.
    assert not {"fo", "kaa", "xex"} & {*spoken()}


def test_all_languages_that_can_be_spoken_are_listed() -> None:
    header, rows = listing()
    assert header[:3] == ("language", "name", "voices")
    assert {row[0] for row in rows} >= {*spoken()}
    by_code = {row[0]: row for row in rows}
    assert by_code["de"][1] == "German"
    assert (by_code["pl"][1], by_code["pl"][2]) == ("Polish", "1")
    assert header[6:] == ("numbers and dates", "tested")
    assert by_code["pl"][3:] == ("", "", "", "yes", "yes")
    assert by_code["cmn"][3:] == ("yes", "", "yes", "yes", "yes")
    assert by_code["sv"][3:] == ("", "", "", "", "")
