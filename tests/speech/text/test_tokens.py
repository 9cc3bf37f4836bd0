"""Tokens: words as a reader counts them, each at its place."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.speech.text.tokens import is_speakable, tokenize, with_words


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", []),
        ("… — ! 😀", []),
        ("Oh, really? I like it.", ["Oh", "really", "I", "like", "it"]),
        ("“Quoted” (words) — it’s ‘fine’", ["Quoted", "words", "it’s", "fine"]),
        ("a must-have! Yes—no--maybe wait...what", ["a", "must-have", "Yes", "no", "maybe", "wait", "what"]),
        (
            "$5.50 12,345.67 3:45pm 50% 20°C -5 2nd",
            ["$5.50", "12,345.67", "3:45pm", "50%", "20°C", "-5", "2nd"],
        ),
        ("C++ & C# a@b.com #tag", ["C++", "&", "C#", "a@b.com", "#tag"]),
        ("see www.example.com/a-b.", ["see", "www.example.com/a-b"]),
        ("e\u0301te\u0301 soft\u00adhyphen a\u200bb", ["e\u0301te\u0301", "soft\u00adhyphen", "a", "b"]),
        ("你好 hello हिन्दी", ["你", "好", "hello", "हिन्दी"]),
        ("one,two 1,2", ["one", "two", "1,2"]),
        ("❤\ufe0f 👩\u200d👧", []),
    ],
)
def test_cases(text, expected) -> None:
    assert [token.text for token in tokenize(text)] == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", []),
        ("今天天气很好", ["今天", "天气", "很", "好"]),
        ("在大学生活", ["在", "大学生", "活"]),  # the longest word first
        ("今 天，今\n天", ["今", "天", "今", "天"]),  # what is apart is not joined
        ("OK今天ok 3天", ["OK", "今天", "ok", "3", "天"]),
    ],
)
def test_characters_become_words(text: str, expected: list[str]) -> None:
    words = frozenset(("今天", "天气", "大学", "大学生", "学生", "生活", "ok"))
    tokens = with_words(tokenize(text), words)
    assert [token.text for token in tokens] == expected
    assert [text[token.start : token.end] for token in tokens] == expected
    assert with_words(tokenize(text), frozenset()) == tokenize(text)


@given(st.text(max_size=60))
def test_tokens_stand_where_they_say_and_in_order(text) -> None:
    end = 0
    for token in tokenize(text):
        assert text[token.start : token.end] == token.text
        assert end <= token.start < token.end
        end = token.end


@given(st.text(max_size=60))
def test_every_letter_and_digit_is_in_a_token(text) -> None:
    covered = {index for token in tokenize(text) for index in range(token.start, token.end)}
    assert all(index in covered for index, char in enumerate(text) if char.isalnum())


@given(st.text(max_size=60))
def test_what_can_be_spoken_has_tokens(text) -> None:
    assert is_speakable(text) == bool(tokenize(text))
