"""Questions: told apart by the words of a sentence."""

from __future__ import annotations

import pytest

from risorius.core.utterance import Question
from risorius.speech.structure.questions import question_of

WH, YES_NO, OR, UNMARKED = Question.WH, Question.YES_NO, Question.ALTERNATIVE, Question.UNMARKED


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [
        ("en-us", "What is it", WH),
        ("en-us", "Well what about Julia", WH),
        ("en-gb", "In which house", WH),
        ("en-us", "Is it when you can", YES_NO),
        ("en-us", "Do you like it", YES_NO),
        ("en-us", "And are you there", YES_NO),
        ("en-us", "Aren’t you", YES_NO),
        ("en-us", "Is it tea or coffee", OR),
        ("en-us", "Tea or coffee", OR),
        ("en-us", "You like it", UNMARKED),
        ("en-us", "Or", UNMARKED),
    ],
)
def test_kinds(language: str, text: str, expected: Question) -> None:
    assert question_of(text.split(), language) is expected
