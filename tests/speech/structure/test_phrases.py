"""Phrases and sentences: where they end, how they end and what they ask."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.speech.utterance import Boundary, Ending, Phrase, Question, Utterance
from risorius.speech.structure.phrases import find_phrases, with_phrases
from risorius.speech.synthesis import synthesize_line

Maker = Callable[..., Utterance]


def phrased(said: Utterance) -> list[tuple[str, Ending, Question, int]]:
    return [(_text(said, p), p.ending, p.question, p.sentence) for p in said.phrases]


def _text(said: Utterance, phrase: Phrase) -> str:
    return " ".join(word.text for word in said.words[phrase.first_word : phrase.last_word])


def test_nothing_said_has_no_phrases(utterance_of: Maker) -> None:
    assert with_phrases(utterance_of("")).phrases == ()


@given(st.lists(st.sampled_from(["one", "two,", "three.", "four?", "what", "or", "…"]), max_size=12))
def test_phrases_are_the_words_in_order_and_sentences_are_phrases(tokens: list[str]) -> None:
    if not any(token.strip("…,.?") for token in tokens):
        return
    said = synthesize_line(" ".join(tokens))
    assert [p.first_word for p in said.phrases] == [0, *(p.last_word for p in said.phrases[:-1])]
    assert said.phrases[-1].last_word == len(said.words)
    assert all(b.sentence - a.sentence in (0, 1) for a, b in pairwise(said.phrases))
    assert {b.word for b in said.boundaries} == {p.last_word - 1 for p in said.phrases}
    assert [s.first_word for s in said.sentences] == [0, *(s.last_word for s in said.sentences[:-1])]
    for phrase in said.phrases:
        sentence = said.sentences[phrase.sentence]
        assert (phrase.start, phrase.end) == (
            said.words[phrase.first_word].start,
            said.words[phrase.last_word - 1].end,
        )
        assert sentence.first_word <= phrase.first_word < phrase.last_word <= sentence.last_word
        assert phrase.question is sentence.question


NONE, WH, YES_NO = Question.NONE, Question.WH, Question.YES_NO


@pytest.mark.parametrize(
    ("marked", "expected"),
    [
        ("one two.", [("one two", Ending.STATEMENT, NONE, 0)]),
        ("one, two.", [("one", Ending.CONTINUATION, NONE, 0), ("two", Ending.STATEMENT, NONE, 0)]),
        ("one! two…", [("one", Ending.EXCLAMATION, NONE, 0), ("two", Ending.HESITATION, NONE, 1)]),
        (
            "who, you? is it?",
            [
                ("who", Ending.CONTINUATION, WH, 0),
                ("you", Ending.WH_QUESTION, WH, 0),
                ("is it", Ending.YES_NO_QUESTION, YES_NO, 1),
            ],
        ),
        ("one two", [("one two", Ending.OPEN, NONE, 0)]),
    ],
)
def test_endings_by_punctuation(
    marked: str, expected: list[tuple[str, Ending, Question, int]], sentence_of: Maker
) -> None:
    assert phrased(sentence_of(marked)) == expected


def test_a_boundary_ends_a_phrase_within_its_sentence(sentence_of: Maker) -> None:
    said = sentence_of("one two three.")
    inner = replace(said, boundaries=(Boundary(said.words[0].end, 0, "L-"), *said.boundaries))
    assert phrased(with_phrases(inner)) == [
        ("one", Ending.CLAUSE, NONE, 0),
        ("two three", Ending.STATEMENT, NONE, 0),
    ]


def test_a_clause_begins_a_phrase_without_a_pause_if_wanted(sentence_of: Maker) -> None:
    said = sentence_of("we all went home because it rained again.")
    assert [(p.first_word, p.ending) for p in find_phrases(said, (), clauses=True)] == [
        (0, Ending.CLAUSE),
        (4, Ending.STATEMENT),
    ]
    assert len(find_phrases(said, ())) == 1


def test_an_abbreviation_ends_no_sentence() -> None:
    said = synthesize_line("What does Dr. Smith want? Is Dr. Smith in?")
    assert [(s.first_word, s.question) for s in said.sentences] == [(0, WH), (5, YES_NO)]


def test_a_sentence_without_a_pause_after_it_still_ends(utterance_of: Maker) -> None:
    said = utterance_of("AA IY")
    words = (
        replace(said.words[0], source_start=0, source_end=2),
        replace(said.words[1], source_start=4, source_end=6),
    )
    run_on = with_phrases(replace(said, text="aa? Iy", words=words, phrases=()))
    assert [s.question for s in run_on.sentences] == [Question.UNMARKED, NONE]


def test_a_spanish_question_begins_with_its_sign(sentence_of: Maker) -> None:
    said = replace(sentence_of("Hola, quién viene?"), language="es", phrases=())
    marked = replace(
        said,
        text="Hola, ¿quién viene?",
        words=tuple(
            replace(w, source_start=w.source_start + (i > 0), source_end=w.source_end + (i > 0))
            for i, w in enumerate(said.words)
        ),
    )
    assert [p.question for p in with_phrases(marked).phrases] == [WH, WH]
