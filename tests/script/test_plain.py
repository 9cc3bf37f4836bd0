import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.errors import InputError, Place
from risorius.script.model import SpokenLine
from risorius.script.plain import parse_plain
from risorius.script.speakable import MAX_CHARACTERS, position

CONTROL = re.compile(r"[\0-\x08\x0e-\x1f\x7f-\x84\x86-\x9f\ud800-\udfff]")
BAD = [
    ("empty", "", "text:1: the text is empty; expected words to speak"),
    ("blank", " \n\t ", "text:1: the text is empty; expected words to speak"),
    ("marks", "?! …", "text:1: nothing can be spoken in '?! …'; expected a letter or digit"),
    ("no line end", "—\n—", "text:1: nothing can be spoken in '— —'; expected a letter or digit"),
    ("too long", "a" * 100_001, "text:1: the text has 100,001 characters; expected at most 100,000"),
    ("NUL", "one\ntwo\0", "text:2:4: U+0000 is not a character of a text; expected plain words"),
    ("escape", "\x1b[1m", "text:1:1: U+001B is not a character of a text; expected plain words"),
    ("broken argument", "a\udcff", "text:1:2: U+DCFF is not a character of a text; expected plain words"),
]


@pytest.mark.parametrize(("text", "message"), [row[1:] for row in BAD], ids=[row[0] for row in BAD])
def test_what_cannot_be_spoken_is_refused(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_plain(text)
    assert str(caught.value) == message


def test_messages_name_the_source() -> None:
    with pytest.raises(InputError, match=r"^stdin:1: "):
        parse_plain("", "stdin")


def speakable(text: str) -> bool:
    return any(c.isalnum() for c in text)


@given(st.text(st.characters(exclude_categories=("Cc", "Cs"))).filter(speakable))
def test_any_text_is_spoken_as_it_stands(text: str) -> None:
    script = parse_plain(text)
    assert script.text == text
    assert script.lines == (SpokenLine(text, None, Place("text", 1, 1)),)
    assert script.marks == ()
    assert not script.timed


@given(st.text(max_size=30))
def test_a_text_is_spoken_or_refused_in_one_line(text: str) -> None:
    refusals: list[str] = []
    try:
        parse_plain(text)
    except InputError as error:
        refusals.append(str(error))
    assert bool(refusals) is not (speakable(text) and not CONTROL.search(text))
    assert all(refusal.isprintable() for refusal in refusals)


@pytest.mark.parametrize("text", ["Ⅻ", "7", "你好", "नमस्ते", "a\r\nb\tc", "x" * MAX_CHARACTERS])
def test_texts_that_can_be_spoken(text: str) -> None:
    assert parse_plain(text).text == text


def test_positions_count_lines_and_columns_from_one() -> None:
    assert [position("f", "ab\nc", i) for i in (0, 1, 3)] == [
        Place("f", 1, 1), Place("f", 1, 2), Place("f", 2, 1)
    ]  # fmt: skip
