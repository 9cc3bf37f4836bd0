"""Text that is appended changes nothing that was said before it."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.speech.utterance import Utterance
from risorius.script import read_script
from risorius.speech import synthesize_script

from ..profiles import examples

# Seconds before the end of the old text's last sentence from which on something may change.
HORIZON = 0.25
SENTENCES = st.lists(
    st.sampled_from(
        [
            "Hello there.",
            "Oh, really?",
            "What does Dr. Smith want?",
            "I like it very much, but nobody knows!",
            "Um, well... I went home early because the weather changed.",
            "It costs $5.50 at 3 p.m. on Monday.",
            "Do you like popcorn or nuts?",
        ]
    ),
    min_size=1,
    max_size=2,
)


@cache
def spoken(text: str, language: str | None = None) -> Utterance:
    return synthesize_script(read_script(text, text=True), language=language)


def before(said: Utterance, limit: float) -> dict[str, Any]:
    """Return all that has ended by a time, and the starts of what begins by then."""
    return {
        "phones": [p for p in said.phones if p.end <= limit],
        "words": [w for w in said.words if w.end <= limit],
        "syllables": [s for s in said.syllables if s.end <= limit],
        "pauses": [p for p in said.pauses if p.end <= limit],
        "accents": [a for a in said.accents if said.words[a.word].end <= limit],
        "boundaries": [b for b in said.boundaries if b.time <= limit],
        "phrases": [p for p in said.phrases if p.end <= limit],
    }


@examples(60)
@given(SENTENCES, SENTENCES)
def test_appended_text_changes_nothing_earlier(old: list[str], more: list[str]) -> None:
    short, long = spoken(" ".join(old)), spoken(" ".join([*old, *more]))
    limit = short.words[-1].end - HORIZON
    assert before(long, limit) == before(short, limit)


@pytest.mark.parametrize(
    ("language", "old", "more"),
    [
        ("de", "Was machst du? Ich gehe am 3. Oktober nach Hause.", "Kommst du?"),
        ("es", "Hola, ¿cómo estás? Muy bien.", "¿Has visto a Juan?"),
        ("cmn", "你好，我是中国人。", "你好吗？"),
    ],
)
def test_in_every_language(language: str, old: str, more: str) -> None:
    short, long = spoken(old, language), spoken(f"{old} {more}", language)
    limit = short.words[-1].end - HORIZON
    assert before(long, limit) == before(short, limit)
