"""Pauses take their kind from the punctuation around them."""

from __future__ import annotations

import pytest

from risorius.core.speech.utterance import PauseKind, Phone, Word
from risorius.languages import language_of
from risorius.speech.structure.lines import TextLine
from risorius.speech.structure.pauses import find_pauses, punctuation_kind

K = PauseKind


@pytest.mark.parametrize(
    ("between", "kind"),
    [
        ("", None),
        (" ", None),
        (" “", None),
        (", ", K.COMMA),
        ("; ", K.COMMA),
        (" (", K.COMMA),
        (" — ", K.COMMA),
        (" - ", K.COMMA),
        (". ", K.FULL_STOP),
        ("\n\n", K.FULL_STOP),
        ("? ", K.QUESTION),
        ("?! ", K.QUESTION),
        ("! ", K.EXCLAMATION),
        ("... ", K.HESITATION),
        ("… ", K.HESITATION),
        ("。", K.FULL_STOP),
        ("，", K.COMMA),
        ("؟", K.QUESTION),
    ],
)
def test_punctuation(between, kind) -> None:
    assert punctuation_kind(between) is kind


def pauses(text: str, silence: float = 0.3, lead: float = 0.5, tail: float = 0.7) -> list[tuple[str, float]]:
    """Find the pauses of two words with silence around and between them."""
    first, last = text.split("_")[0], text.split("_")[-1]
    words = text.replace("_", " ").replace("\n", " ").split()
    a, b = (w.strip(",.?!…") for w in (words[0], words[1]))
    plain = text.replace("_", "")
    spans = [("", lead, -1), ("AA", 0.1, 0), ("", silence, -1), ("AA", 0.1, 1), ("", tail, -1)]
    phones, at = [], 0.0
    for symbol, length, word in spans:
        if length:
            phones.append(Phone(symbol, at, at + length, 0 if symbol else -1, word))
        at += length
    spoken = [
        Word(w, 0.0, 1.0, 1, 2, plain.index(w), plain.index(w) + len(w)) for w in (a, b) if first and last
    ]
    found = find_pauses(plain, phones, spoken, language_of("en"))
    assert all(p.start < p.end for p in found)
    return [(p.kind, round(p.end - p.start, 6)) for p in found]


def test_lead_and_tail() -> None:
    assert pauses("one two", silence=0.0) == [(K.INITIAL, 0.5), (K.FINAL, 0.7)]
    assert pauses("one two", silence=0.0, lead=0.0, tail=0.0) == []


@pytest.mark.parametrize(("mark", "kind"), [(".", K.FULL_STOP), ("?", K.QUESTION), ("!", K.EXCLAMATION)])
def test_the_last_silence_is_one_pause_of_the_last_punctuation(mark, kind) -> None:
    assert pauses(f"one two{mark}", silence=0.0) == [(K.INITIAL, 0.5), (kind, 0.7)]


def test_between_words() -> None:
    assert (K.COMMA, 0.3) in pauses("one, two")
    assert (K.QUESTION, 0.05) in pauses("one? two", silence=0.05)
    assert (K.COMMA, 0.16) in pauses("one two", silence=0.16)
    assert len(pauses("one two", silence=0.14)) == 2


def test_fillers_hesitate() -> None:
    assert (K.HESITATION, 0.3) in pauses("Um, two")
    assert (K.HESITATION, 0.2) in pauses("uh two", silence=0.2)
    assert (K.FULL_STOP, 0.3) in pauses("um. Two")


def test_silence_inside_a_word_is_no_pause() -> None:
    phones = [Phone("AA", 0.0, 0.1, 0, 0), Phone("", 0.1, 0.4), Phone("AA", 0.4, 0.5, 0, 0)]
    assert find_pauses("one", phones, [Word("one", 0.0, 0.5, 0, 3, 0, 3)], language_of("en")) == ()


@pytest.mark.parametrize(
    ("text", "edges", "kinds"),
    [
        ("one\ntwo", (2, 3), [K.INITIAL, K.FULL_STOP]),
        ("one?\ntwo", (2, 3), [K.INITIAL, K.FULL_STOP]),
        ("one?\ntwo", (3, 3), [K.INITIAL, K.QUESTION]),
        ("one\ntwo?", (3, 3), [K.INITIAL, K.FULL_STOP]),
        ("um,\ntwo", (3, 3), [K.INITIAL, K.COMMA]),
    ],
)
def test_all_silence_between_two_lines_is_one_pause(text, edges, kinds) -> None:
    """The first line has the phones before the first edge, the second line those from the second edge on."""
    symbols = [("", -1), ("AA", 0), ("", -1), ("", -1), ("AA", 1)]
    phones = [Phone(s, i, i + 1, 0 if s else -1, word) for i, (s, word) in enumerate(symbols)]
    cut = text.index("\n")
    length = len(text[:cut].strip(",?"))
    words = [Word(text[:length], 1, 2, 1, 2, 0, length), Word("two", 4, 5, 4, 5, cut + 1, cut + 4)]
    lines = [TextLine(range(edges[0]), range(cut)), TextLine(range(edges[1], 5), range(cut + 1, len(text)))]
    found = find_pauses(text, phones, words, language_of("en"), lines)
    assert [p.kind for p in found] == kinds
    assert [(p.start, p.end) for p in found] == [(0, 1), (2, 4)]


def test_silence_before_the_first_of_two_lines_is_initial() -> None:
    symbols = [("", -1), ("", -1), ("AA", 0), ("", -1), ("AA", 1)]
    phones = [Phone(s, i, i + 1, 0 if s else -1, word) for i, (s, word) in enumerate(symbols)]
    words = [Word("a", 2, 3, 2, 3, 0, 1), Word("b", 4, 5, 4, 5, 2, 3)]
    lines = [TextLine(range(1, 3), range(1)), TextLine(range(4, 5), range(2, 3))]
    found = find_pauses("a\nb", phones, words, language_of("en"), lines)
    assert [(p.start, p.end, p.kind) for p in found] == [(0, 2, K.INITIAL), (3, 4, K.FULL_STOP)]
