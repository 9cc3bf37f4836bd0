"""Accents: content words, on their stressed syllable; one nucleus per phrase."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.directions import UNDIRECTED, DirectedSpan, Directions, Emphasis, ToneMark
from risorius.core.speech.tobi import BOUNDARY_TONES, PITCH_ACCENTS
from risorius.errors import Place
from risorius.rules.voice_emotion import voice_manner
from risorius.speech.synthesis import synthesize_line

HERE = Place("text", 1, 1)


def accented(text: str, engine) -> list[str]:
    """Return the accented words, nuclei in capitals."""
    said = synthesize_line(text, engine=engine)
    return [
        said.words[a.word].text.upper() if a.nuclear else said.words[a.word].text.lower()
        for a in said.accents
    ]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("My baby brother put the map by the beam.", ["baby", "brother", "map", "BEAM"]),
        ("Oh, really? I like it very much.", ["OH", "REALLY", "very", "MUCH"]),
        ("The cat sat, the dog ran.", ["cat", "SAT", "dog", "RAN"]),
    ],
)
def test_cases(text, expected, engine) -> None:
    assert accented(text, engine) == expected


def test_a_phrase_without_content_words_has_an_accent_all_the_same(engine) -> None:
    said = synthesize_line("Is it?", engine=engine)
    assert [(a.nuclear, a.label, a.confidence) for a in said.accents] == [(True, "L*", 0.45)]


WORDS = st.sampled_from(["map,", "the", "Bob.", "of", "banana", "is;", "really?", "a"])


@given(st.lists(WORDS, min_size=1, max_size=10))
def test_accents_are_in_order_inside_their_syllables(words) -> None:
    said = synthesize_line(" ".join(words))
    assert [a.time for a in said.accents] == sorted(a.time for a in said.accents)
    for accent in said.accents:
        syllable = said.syllables[accent.syllable]
        assert syllable.start < accent.time < syllable.end
        assert syllable.word == accent.word
        assert accent.label in PITCH_ACCENTS
        assert 0 < accent.confidence <= 1
    assert said.accents[-1].nuclear
    assert [b.time for b in said.boundaries] == sorted(b.time for b in said.boundaries)
    assert said.boundaries[-1].word == len(said.words) - 1
    assert all(b.label in BOUNDARY_TONES and 0 < b.confidence < 1 for b in said.boundaries)


def tune(text: str, directions: Directions = UNDIRECTED, language: str | None = None) -> str:
    """Return a text's tones: words in brackets by phrase, each with its accent, then the boundary."""
    said = synthesize_line(text, directions=directions, language=language)
    accents = {a.word: f"/{a.label}" for a in said.accents}
    ends = {b.word: f" {b.label})" for b in said.boundaries}
    starts = {0, *(b.word + 1 for b in said.boundaries)}
    return " ".join(
        ("(" if i in starts else "") + w.text.lower() + accents.get(i, "") + ends.get(i, "")
        for i, w in enumerate(said.words)
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Bob ran.", "(bob/H* ran/H* L-L%)"),
        ("Did Bob run?", "(did bob/H* run/L* H-H%)"),
        ("Where did Bob run?", "(where did bob/H* run/H* L-L%)"),
        ("Is it tea or coffee?", "(is it tea/H* or coffee/H* L-L%)"),
        ("Bob ran!", "(bob/H* ran/L+H* L-L%)"),
        ("When Bob ran, Mary sang.", "(when bob/H* ran/H* L-H%) (mary/H* sang/H* L-L%)"),
        ("Bob ran", "(bob/H* ran/H* L-L%)"),
        (
            "I went home early because the weather changed.",
            "(i went home/H* early/H* L-) (because the weather/H* changed/H* L-L%)",
        ),
    ],
)
def test_tunes_by_punctuation_and_clause(text: str, expected: str) -> None:
    assert tune(text) == expected


def test_questions_of_other_languages_rise() -> None:
    assert tune("Kommt Anna?", language="de").endswith("H-H%)")


def test_a_language_of_tones_has_one_accent_per_phrase_of_unknown_kind() -> None:
    assert tune("你好，我是中国人。", language="cmn") == "(你好/* L-H%) (我 是 中国人/* L-L%)"


def test_what_follows_the_focus_is_not_accented() -> None:
    text = "Mary gave the red book to Bob."
    red = DirectedSpan(text.index("red"), text.index("red") + 3, HERE, emphasis=Emphasis.STRONG)
    assert tune(text, Directions((red,))) == "(mary/H* gave the red/L+H* book to bob L-L%)"


def test_a_focused_function_word_is_accented() -> None:
    it = DirectedSpan(5, 7, HERE, emphasis=Emphasis.MODERATE)
    assert tune("I am it.", Directions((it,))) == "(i am it/L+H* L-L%)"


def test_tones_by_hand_stand_and_the_rules_fill_other_phrases() -> None:
    directions = Directions(
        accents=(ToneMark(0, "L+H*", HERE), ToneMark(14, "H*", HERE)),
        boundaries=(ToneMark(6, "L-H%", HERE),),
    )
    assert tune("Julia prefers popcorn. Bob ran.", directions) == (
        "(julia/L+H* prefers L-H%) (popcorn/H* L-L%) (bob/H* ran/H* L-L%)"
    )
    said = synthesize_line("Julia prefers popcorn.", directions=directions)
    assert [(a.nuclear, a.confidence) for a in said.accents] == [(True, 1.0), (True, 1.0)]


@pytest.mark.parametrize("emotion", ["anger", "disgust", "fear", "happiness", "sadness", "surprise"])
@pytest.mark.parametrize("text", ["I told you so, my friend. Nobody wanted lemonade!", "Is it you, really?"])
def test_emotion_changes_the_voice_but_no_accent(emotion: str, text: str) -> None:
    plain, moved = synthesize_line(text), synthesize_line(text, manner=voice_manner({emotion: 1.0}))
    assert moved.duration != plain.duration
    assert [(a.word, a.syllable, a.label) for a in moved.accents] == [
        (a.word, a.syllable, a.label) for a in plain.accents
    ]
    assert [(b.word, b.label) for b in moved.boundaries] == [(b.word, b.label) for b in plain.boundaries]
