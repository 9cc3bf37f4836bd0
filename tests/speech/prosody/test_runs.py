"""Runs: what is said between two pauses."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from risorius.core.speech.utterance import Utterance
from risorius.speech.prosody.runs import runs_of

Maker = Callable[..., Utterance]


@pytest.mark.parametrize(
    ("symbols", "words", "syllables"),
    [
        ("", [], []),
        ("AA", [(0, 1)], [(0, 0)]),
        ("AA IY _ UW", [(0, 2), (2, 3)], [(0, 0), (0, 0)]),
        ("_ AA _ _ UW", [(0, 1), (1, 2)], [(0, 0), (0, 0)]),
    ],
)
def test_runs_end_at_pauses(
    symbols: str, words: list[tuple[int, int]], syllables: list[tuple[int, int]], utterance_of: Maker
) -> None:
    found = list(runs_of(utterance_of(symbols)))
    assert [(run.words.start, run.words.stop) for run in found] == words
    assert [(run.syllables.start, run.syllables.stop) for run in found] == syllables


def test_syllables_and_times_are_those_of_the_words(sentence_of: Maker) -> None:
    said = sentence_of("one two, three four five.")
    first, second = runs_of(said)
    assert (first.syllables, second.syllables) == (range(2), range(2, 5))
    assert (second.start, second.end) == (said.words[2].start, said.words[4].end)
