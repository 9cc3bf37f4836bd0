"""Stretches: sentences, bounded in length, that lose nothing."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.languages import language_of
from risorius.speech.text.sentences import LIMIT, divide
from risorius.speech.text.tokens import is_speakable

PIECES = """Mr. Dr. e.g. etc. the cat 3.14 $5.50 U.S. J. said. really? no! wait... “yes” (or) — well, and;
it’s 😀 你好。 long-winded"""
ENGLISH = language_of("en")
TEXTS = st.lists(st.sampled_from([*PIECES.split(), "\n", "\n\n", ""]), max_size=60).map(" ".join)


def sentences(text: str, limit: int = LIMIT) -> list[str]:
    return [text[s.start : s.end].strip() for s in divide(text, ENGLISH, limit)]


@pytest.mark.parametrize("text", ["", "   ", "\n\n", "...", "— ! 😀"])
def test_nothing_to_speak(text) -> None:
    assert divide(text, ENGLISH) == ()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("One. Two! Three? Four", ["One.", "Two!", "Three?", "Four"]),
        ("Mr. Smith met Dr. Jones. He left.", ["Mr. Smith met Dr. Jones.", "He left."]),
        ("J. K. Rowling of the U.S. army came.", ["J. K. Rowling of the U.S. army came."]),
        ("At 5 p.m. it rained. At 5 p.m. Bob left.", ["At 5 p.m. it rained.", "At 5 p.m.", "Bob left."]),
        ("On Jan. 5, it was 3.14 exactly. $5.50!", ["On Jan. 5, it was 3.14 exactly.", "$5.50!"]),
        ("“Really?” she said. “Go!” He went.", ["“Really?” she said.", "“Go!”", "He went."]),
        ("Wait... what? Well... Yes.", ["Wait... what?", "Well...", "Yes."]),
        ("A title\n\nThe text\ngoes on", ["A title", "The text\ngoes on"]),
        ("List:\n- one\n- two", ["List:", "- one", "- two"]),
        ("See example.com. Then go.", ["See example.com.", "Then go."]),
        ("你好。我喜欢！", ["你好。", "我喜欢！"]),
        ("I see No. 5 and e.g. this.", ["I see No. 5 and e.g. this."]),
    ],
)
def test_cases(text, expected) -> None:
    assert sentences(text) == expected


def test_a_long_sentence_is_divided_at_a_clause_then_at_a_blank_then_anywhere() -> None:
    clause = "word " * 12 + "end, " + "more " * 12
    assert [s.strip()[-4:] for s in sentences(clause, 100)] == ["end,", "more"]
    blank = sentences("word " * 50, 100)
    assert all(s.split() == ["word"] * len(s.split()) for s in blank)
    assert sentences("x" * 250, 100) == ["x" * 100, "x" * 100, "x" * 50]


def test_only_the_end_of_a_sentence_ends_it() -> None:
    assert [s.ends_sentence for s in divide("word " * 50, ENGLISH, 100)] == [False, False, True]


@given(TEXTS, st.integers(20, 80))
def test_stretches_are_bounded_ordered_and_hold_all_that_is_spoken(text, limit) -> None:
    stretches = divide(text, ENGLISH, limit)
    end = 0
    for stretch in stretches:
        assert end <= stretch.start < stretch.end <= len(text)
        assert stretch.end - stretch.start <= limit
        assert is_speakable(text[stretch.start : stretch.end])
        assert not is_speakable(text[end : stretch.start])
        end = stretch.end
    assert not is_speakable(text[end:])
