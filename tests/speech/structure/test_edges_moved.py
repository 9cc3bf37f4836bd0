"""Edges of phones moved by hand."""

from __future__ import annotations

from itertools import pairwise

import pytest

from risorius.errors import InputError, SpeechWarning
from risorius.speech import synthesize_line
from risorius.speech.structure.edges_moved import SHORTEST, edge_of, with_edges


@pytest.fixture(scope="module")
def said():
    return synthesize_line("I like it, like you.", lead=0.2, tail=0.2)


def test_what_has_no_edge_is_refused(said):
    for phone in (-1, 0, len(said.phones)):
        with pytest.raises(InputError, match="there is no edge"):
            edge_of(said, phone, 0.1)


def test_times_follow_the_phone_that_is_moved_and_no_other(said):
    word = next(k for k, word in enumerate(said.words) if word.text == "it")
    first = said.words[word].first_phone
    moved = with_edges(said, [edge_of(said, first, 0.03)])
    assert moved.words[word].start == pytest.approx(said.words[word].start + 0.03)
    assert moved.words[word - 1].end == moved.words[word].start == moved.phones[first].start
    assert moved.words[word].end == said.words[word].end
    assert moved.pauses == said.pauses
    assert [p.start for k, p in enumerate(moved.phones) if k != first] == [
        p.start for k, p in enumerate(said.phones) if k != first
    ]
    assert moved.audio is said.audio


def test_an_edge_is_found_again_at_the_same_word_of_another_line(said):
    second = [word for word in said.words if word.text == "like"][1]
    shift = edge_of(said, second.first_phone, -0.02)
    other = synthesize_line("Now I like it, like you.", lead=0.2, tail=0.2)
    again = [word for word in with_edges(other, [shift]).words if word.text == "like"]
    plain = [word for word in other.words if word.text == "like"]
    assert again[1].start == pytest.approx(plain[1].start - 0.02)
    assert again[0] == plain[0]
    with pytest.warns(SpeechWarning, match="like"):
        assert with_edges(synthesize_line("I like it."), [shift]).words


def test_phones_keep_from_each_other_however_far_one_is_moved(said):
    for shift in (-60.0, 60.0):
        phones = with_edges(said, [edge_of(said, 4, shift)]).phones
        assert min(phone.duration for phone in phones) > 0.9 * SHORTEST
        assert all(a.end == b.start for a, b in pairwise(phones))
