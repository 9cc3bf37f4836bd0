"""What is known of a language: strict files, a documented default, and lists that words can match."""

from __future__ import annotations

import unicodedata
from pathlib import Path

import pytest

from risorius.core.speech.utterance import Question
from risorius.errors import InputError
from risorius.languages import language_of, languages, load, plain_word


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the undetermined language and of one that tests write, in place of the package's."""
    for name in ("language.toml", "phones.toml", "intonation.toml"):
        target = tmp_path / "und" / name
        target.parent.mkdir(exist_ok=True)
        target.write_text((load._FOLDER / "und" / name).read_text("utf-8"), "utf-8")
    (tmp_path / "xx").mkdir()
    monkeypatch.setattr(load, "_FOLDER", tmp_path)
    for cached in (load.languages, load._language):
        cached.cache_clear()
    yield tmp_path
    monkeypatch.undo()
    for cached in (load.languages, load._language):
        cached.cache_clear()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("fillers = []", r"xx/language\.toml: key 'name' is missing"),
        ('name = "X"\nfilers = []', r"xx/language\.toml:2:1: unknown key 'filers'; did you mean 'fillers'"),
        ('name = "X"\n[questions]\notherwise = "maybe"', r"language\.toml:3:1: .* expected one of none, wh"),
        ('name = "X"\n[clauses]\nleast = 0', r"language\.toml:3:1: .* is out of range"),
        ('name = "X"\n[function_words]\narticles = "the"', r"language\.toml:3:1: .* expected a list"),
    ],
)
def test_files_that_do_not_fit_are_refused(text: str, message: str, folder: Path) -> None:
    (folder / "xx" / "language.toml").write_text(text)
    with pytest.raises(InputError, match=message):
        language_of("xx")


def test_a_language_is_one_folder(folder: Path) -> None:
    (folder / "xx" / "language.toml").write_text('name = "X"\n[questions]\nwh = ["wot"]')
    (folder / "xx" / "phones.toml").write_text('[spellings]\n"q" = "k"')
    found = language_of("XX_yy")
    assert (found.code, found.name, found.questions.wh) == ("xx", "X", ("wot",))
    # What it does not say is as in the undetermined language; tables are laid over one another.
    assert found.questions.otherwise is Question.YES_NO
    assert found.fillers == language_of("und").fillers
    assert found.spellings == {**language_of("und").spellings, "q": "k"}
    assert found.intonation == language_of("und").intonation


@pytest.mark.parametrize(
    ("code", "folder_code"),
    [("en-us", "en"), ("EN", "en"), ("pt_BR", "pt"), ("vi-vn-x-central", "vi"), ("enm", "und"), ("", "und"),
     ("../en", "und"), ("de-", "de")],
)  # fmt: skip
def test_codes(code: str, folder_code: str) -> None:
    assert language_of(code).code == folder_code


@pytest.mark.parametrize("code", languages())
def test_the_words_of_every_language_are_as_words_are_looked_up(code: str) -> None:
    found = language_of(code)
    tables = found.questions
    listed = (
        *found.function_words, *found.fillers, *found.clauses.before,
        *tables.openers, *tables.wh, *tables.yes_no, *tables.subjects, *tables.hyphenated, *tables.last,
        *tables.alternative,
    )  # fmt: skip
    assert [text for text in (*tables.anywhere, *tables.last_yes_no) if text != plain_word(text)] == []
    assert [word for word in found.words if len(word) < 2 or found.spaces] == []
    assert [word for word in listed if word != plain_word(word) or " " in word] == []
    assert not set(tables.wh) & set(tables.yes_no)


@pytest.mark.parametrize(
    ("code", "word", "expected"),
    [
        ("en", "the", True),
        ("en", "The", True),
        ("en", "OF", True),
        ("en", "it’s", True),
        ("en", "o'clock", False),
        ("en", "map", False),
        ("en", "schön", False),
        ("de", "schön", False),
        ("de", "Für", True),
        ("de", unicodedata.normalize("NFD", "für"), True),
        ("de", "the", False),
        ("fr", "Qu’il", True),
        ("fr", "l'homme", False),
        ("es", "el", True),
        ("es", "él", False),
        ("es", "estás", False),
        ("pl", "the", False),
    ],
)
def test_function_words(code: str, word: str, expected: bool) -> None:
    assert language_of(code).is_function_word(word) is expected


def test_only_english_reads_numbers_for_the_aligner() -> None:
    assert language_of("en").number_readings("5") == ("five",)
    assert language_of("de").number_readings("5") == ()
