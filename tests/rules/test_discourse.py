"""Turns, groups of sentences and rates of phrases."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from risorius.core.speech.utterance import Utterance
from risorius.rules.discourse import groups_of, rate_of_phrase, turns_of
from risorius.rules.synchrony import synchrony

Maker = Callable[..., Utterance]


@pytest.mark.parametrize(
    ("listening", "expected"),
    [
        ([], [(0, 4)]),
        # The pause after "two." is from .98 to 1.28 s.
        ([(1.0, 1.2)], [(0, 2), (2, 4)]),
        ([(0.0, 0.2)], [(0, 4)]),
        ([(0.6, 0.7), (1.0, 1.2), (1.1, 1.3)], [(0, 2), (2, 4)]),
        ([(1.8, 9.0)], [(0, 4)]),
    ],
)
def test_a_turn_ends_where_the_speaker_listens(
    listening: list[tuple[float, float]], expected: list[tuple[int, int]], sentence_of: Maker
) -> None:
    turns = turns_of(sentence_of("one two. three four."), listening)
    assert [(turn.first_word, turn.last_word) for turn in turns] == expected


@pytest.mark.parametrize(
    ("marked", "pause", "expected"),
    [
        ("one. two. three.", 0.3, [0, 0, 0]),
        ("one. two.\nthree.", 0.3, [0, 0, 1]),
        ("one. two.", synchrony().group_pause + 0.1, [0, 1]),
    ],
)
def test_a_new_line_or_a_long_pause_begins_a_group(
    marked: str, pause: float, expected: list[int], sentence_of: Maker
) -> None:
    assert list(groups_of(sentence_of(marked, pause=pause))) == expected


def test_the_rate_is_that_of_the_phrase(sentence_of: Maker, utterance_of: Maker) -> None:
    # A syllable of two phones a word.
    said = sentence_of("one two, three.", phone=0.125)
    assert [rate_of_phrase(said, phrase) for phrase in said.phrases] == pytest.approx([4.0, 4.0])
    bare = utterance_of("AA")
    assert rate_of_phrase(bare, bare.phrases[0]) == synchrony().usual_rate
