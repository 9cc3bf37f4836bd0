"""An utterance whose phones were given other edges by hand: all its times follow, the sound stays."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from itertools import pairwise
from typing import Annotated, TypeVar

import numpy as np

from ...core.arrays import Array
from ...core.speech.utterance import Utterance
from ...errors import InputError, SpeechWarning, warn
from ...reading.hints import Range

SHORTEST = 0.01
"""Seconds that an edge leaves of the phones on both of its sides."""
_TIMES = ("start", "end", "time")

_Item = TypeVar("_Item")
Count = Annotated[int, Range(0, 2**31)]


@dataclass(frozen=True, slots=True)
class EdgeShift:
    """The seconds by which a phone begins later than was found; below 0, earlier.

    The phone is number `phone` of the word `word`, which is said for the `nth` time, both from 0 on; the
    number after that of the word's last phone means the silence after the word. `symbol` is the phone's.
    """

    word: str
    nth: Count
    phone: Count
    symbol: str
    shift: Annotated[float, Range(-60.0, 60.0)]


def edge_of(utterance: Utterance, phone: int, shift: float) -> EdgeShift:
    """Return the shift of the edge at which a phone, by its index, begins.

    Raises InputError for a phone without a word before it, and for an index out of range.
    """
    if not 0 < phone < len(utterance.phones):
        raise InputError(f"there is no edge {phone}; expected 1 to {len(utterance.phones) - 1}")
    word = utterance.phones[phone].word
    if word < 0:
        word = utterance.phones[phone - 1].word
    if word < 0:
        raise InputError("no word ends or begins at this edge")
    spoken = utterance.words[word]
    nth = sum(other.text == spoken.text for other in utterance.words[:word])
    symbol = utterance.phones[phone].symbol
    return EdgeShift(spoken.text, nth, phone - spoken.first_phone, symbol, shift)


def with_edges(utterance: Utterance, shifts: Sequence[EdgeShift]) -> Utterance:
    """Return the utterance with phones that begin elsewhere.

    Warns (SpeechWarning) of shifts that do not fit.
    """
    starts = np.array([phone.start for phone in utterance.phones] + [utterance.duration])
    moved = starts.copy()
    words: dict[tuple[str, int], int] = {}
    counts: Counter[str] = Counter()
    for number, word in enumerate(utterance.words):
        words[word.text, counts[word.text]] = number
        counts[word.text] += 1
    misfits = []
    for shift in shifts:
        word_number = words.get((shift.word, shift.nth))
        index = -1 if word_number is None else utterance.words[word_number].first_phone + shift.phone
        there = 0 < index < len(utterance.phones) and utterance.phones[index].symbol == shift.symbol
        if there:
            moved[index] += shift.shift
        else:
            misfits.append(shift.word)
    if misfits:
        named = ", ".join(dict.fromkeys(misfits))
        warn(f"hand-moved phone boundaries no longer match this line, at: {named}", SpeechWarning)
    return _mapped(utterance, starts, _apart(moved)) if (moved != starts).any() else utterance


def _apart(starts: Array) -> Array:
    """Return rising edges within the sound: each keeps from those beside it."""
    apart = starts.copy()
    last = len(apart) - 1
    for k in range(1, last):
        apart[k] = max(apart[k], apart[k - 1] + SHORTEST)
    for k in range(last - 1, 0, -1):
        apart[k] = min(apart[k], apart[k + 1] - SHORTEST)
    if any(b <= a for a, b in pairwise(apart)):
        raise InputError(f"two boundaries are too close: each phone needs at least {1000 * SHORTEST:g} ms")
    return apart


def _mapped(utterance: Utterance, before: Array, after: Array) -> Utterance:
    def at(item: _Item) -> _Item:
        names = [f.name for f in fields(item) if f.name in _TIMES]  # type: ignore[arg-type]
        times = {name: float(np.interp(getattr(item, name), before, after)) for name in names}
        return replace(item, **times)  # type: ignore[type-var]

    return replace(
        utterance,
        phones=tuple(map(at, utterance.phones)),
        words=tuple(map(at, utterance.words)),
        syllables=tuple(map(at, utterance.syllables)),
        pauses=tuple(map(at, utterance.pauses)),
        accents=tuple(map(at, utterance.accents)),
        boundaries=tuple(map(at, utterance.boundaries)),
        phrases=tuple(map(at, utterance.phrases)),
        marks=tuple(map(at, utterance.marks)),
    )
