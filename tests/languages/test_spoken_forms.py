"""Spoken forms of dates, times, numbers and signs: `spoken_forms.toml` has the rows and their sources."""

from __future__ import annotations

import time
import tomllib
from pathlib import Path

import pytest

from risorius.core.directions import UNDIRECTED
from risorius.languages import language_of
from risorius.languages.load import languages
from risorius.languages.spoken_forms import read_otherwise
from risorius.speech.synthesis import synthesize_line
from risorius.speech.text.normalise import normalise
from risorius.speech.text.sentences import divide
from risorius.speech.text.shape import worded

ROWS = tomllib.loads(Path(__file__).with_name("spoken_forms.toml").read_text(encoding="utf-8"))
CASES = [(code, text, said) for code, rows in ROWS.items() for text, said, _ in rows]


def said_for(text: str, code: str) -> str:
    """Return the text that the voice is given, its sentences divided by slashes."""
    language = language_of(code)
    words = worded(text, UNDIRECTED, language, code)
    stretches = divide(words.shape, language)
    spoken = (normalise(words.text, s.start, s.end, language, words.dictated).text for s in stretches)
    return " / ".join(" ".join(part.split()) for part in spoken).replace(" .", ".").replace(" ,", ",")


@pytest.mark.parametrize(("code", "text", "said"), CASES, ids=[f"{code} {text}" for code, text, _ in CASES])
def test_it_is_said_as_people_say_it(code: str, text: str, said: str) -> None:
    assert said_for(text, code) == said


def test_every_tested_language_has_ten_rows() -> None:
    tested = [code for code in languages() if language_of(code).tested]
    counts = {
        code: sum(len(rows) for key, rows in ROWS.items() if key.split("-")[0] == code) for code in tested
    }
    assert {code: count for code, count in counts.items() if count < 10} == {}


def test_a_language_without_tables_only_joins_the_digits_of_a_number() -> None:
    assert said_for("10 000, 4/5/2021, 17:45, x > 5", "sv") == "10000, 4/5/2021, 17:45, x 5"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Add ½ cup.", ["Add", "½", "cup"]),
        ("It ends 4/23/2021, 5:02 PM.", ["It", "ends", "4/23/2021", "5:02", "PM"]),
        ("10 000 people", ["10 000", "people"]),
        ("a≥5→b", ["a", "≥", "5", "→", "b"]),
        ("On Jan. 5th, 2021.", ["On", "Jan", "5th", "2021"]),
        ("5 km or 5km", ["5", "km", "or", "5km"]),
        ("(555) 123-4567 now", ["(555) 123-4567", "now"]),
        ("5-10% of it", ["5-10%", "of", "it"]),
    ],
)
def test_a_reading_is_a_word_of_its_own(text: str, words: list[str]) -> None:
    assert [token.text for token in worded(text, UNDIRECTED, language_of("en"), "en-us").tokens] == words


@pytest.mark.parametrize(
    ("text", "word", "phones"),
    [
        ("Add ½ cup of milk.", "½", "AH HH AE F"),
        ("Add ¼ more.", "¼", "AH K W AO R D ER"),
        ("We open → the door.", "→", "T AH"),
        ("10 000 people came.", "10 000", "T EH N TH AW Z AH N D"),
        ("It is 3 × 4 now.", "×", "T AY M Z"),
        ("On March 3 we go.", "3", "TH ER D"),
    ],
)
def test_a_label_covers_exactly_the_sounds_of_its_word(text: str, word: str, phones: str) -> None:
    utterance = synthesize_line(text)
    (found,) = (w for w in utterance.words if w.text == word)
    sounds = [p.symbol for p in utterance.phones[found.first_phone : found.last_phone] if p.symbol]
    assert " ".join(sounds) == phones


@pytest.mark.parametrize(
    ("code", "text", "word", "phones"),
    [
        ("it", "Costa 12,50 € qui.", "€", "ɛ ʊ r o e tʃ i n k w a n t a tʃ e n t ɛ z i m ɪ"),
        ("nl", "De 1e keer nu.", "1e", "ɪ r s t ə"),
        ("nl", "Willem III kwam.", "III", "d ə d ɛ r d ə"),
        ("pl", "Jest 5 km dalej.", "km", "k i l ɔ m ɛ t r u v"),
        ("pl", "Film jest o 9:00 dziś.", "9:00", "dʑ ɛ v ɔ n t ɛ j"),
        ("ru", "Это 5 руб. за хлеб.", "руб", "r u b ɭ e j"),
        ("vi", "Lần thứ 1 đây.", "1", "ɲ ə t̪"),
        ("hi", "सुबह 9:00 बजे आना।", "9:00", "n ɔː"),
        ("cmn", "有10 000人来。", "10 000", "j i w ɑ n"),
    ],
)
def test_a_label_covers_its_sounds_in_other_languages(code: str, text: str, word: str, phones: str) -> None:
    utterance = synthesize_line(text, language=code)
    (found,) = (w for w in utterance.words if w.text == word)
    sounds = [p.symbol for p in utterance.phones[found.first_phone : found.last_phone] if p.symbol]
    assert " ".join(sounds) == phones


@pytest.mark.parametrize(
    "part", ["1 ", "1/", "$1", "12-", "1 x ", "+1 2", "1 A", "@a.b", "(555) ", "5 N ", " Henry X"]
)
def test_hostile_numbers_take_no_time(part: str) -> None:
    start = time.process_time()
    read_otherwise(part * (20_000 // len(part)), "en-us")
    assert time.process_time() - start < 1.0


@pytest.mark.parametrize("code", ["it", "pt", "nl", "pl", "ru", "vi", "hi", "cmn"])
@pytest.mark.parametrize("part", ["1 ", "1.", "1,", "1 000 ", "€1", "XX ", "2021 ", "1:", "1-", "½", "1 ½ "])
def test_hostile_numbers_take_no_time_in_other_languages(code: str, part: str) -> None:
    start = time.process_time()
    read_otherwise(part * (20_000 // len(part)), code)
    assert time.process_time() - start < 1.0


@pytest.mark.parametrize(
    ("code", "text", "said"),
    [
        ("en-us", "Call +49 30 123456.", "Call +4 9, 3 0, 1 2 3 4 5 6."),
        (
            "en-us",
            "Call +1 415-555-0123 now.",
            "Call plus one, four one five, five five five, oh one two three now.",
        ),
        ("de", "Ruf +43 1 71100 an.", "Ruf +4 3, 1, 7 1 1 0 0 an."),
        ("en-us", "So 3 * 4 or 5*6*7.", "So 3 times 4 or 5 times 6 times 7."),
        ("de", "Also 3 * 4.", "Also 3 mal 4."),
        ("en-us", "Due 2024-02-29T08:30.", "Due February twenty ninth twenty twenty four, eight thirty."),
        ("de", "Am 2024-02-29T17:05.", "Am neunundzwanzigsten Februar zweitausendvierundzwanzig, 17 Uhr 5."),
    ],
)
def test_numbers_of_telephones_products_and_dates_with_times(code: str, text: str, said: str) -> None:
    assert said_for(text, code) == said
