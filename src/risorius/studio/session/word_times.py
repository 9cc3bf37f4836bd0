"""Map the times of a line to the same line with another text, by its words and phones."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from enum import IntEnum

from ...core.speech.utterance import Phone, Utterance, Word


class Fit(IntEnum):
    """The way in which a time is found again: not at all, at a word in place of its own, at the same word."""

    GONE = 0
    REPLACED = 1
    SAME = 2


@dataclass(frozen=True, slots=True)
class Stretched:
    """The seconds [start, end) lie at [new_start, new_end] in the other line."""

    start: float
    end: float
    new_start: float
    new_end: float
    fit: Fit

    def at(self, time: float) -> float:
        """Return where a time lies."""
        if self.end <= self.start:
            return self.new_start
        share = (time - self.start) / (self.end - self.start)
        return self.new_start + share * (self.new_end - self.new_start)


class WordTimes:
    """A map from the times of one utterance to those of another.

    Words that are the same are followed phone by phone; where as many words stand in place of others, each
    follows one. A pause belongs to the word before it.
    """

    def __init__(self, before: Utterance | None, after: Utterance | None) -> None:
        self._parts: list[Stretched] = []
        if before is not after and before is not None and after is not None:
            self._parts = list(_parts(before, after))
        self._starts = [part.start for part in self._parts]

    def at(self, time: float) -> tuple[float, Fit]:
        """Return a time's new place, and how it was found; times of a lost word lie where it would stand."""
        if not self._parts:
            return time, Fit.SAME
        part = self._parts[max(0, bisect_right(self._starts, time) - 1)]
        return part.at(time), part.fit


def _parts(before: Utterance, after: Utterance) -> Iterator[Stretched]:
    pairs = _pairs(before.words, after.words)
    first_old = before.words[0].start if before.words else before.duration
    first_new = after.words[0].start if after.words else after.duration
    yield Stretched(0.0, first_old, 0.0, first_new, Fit.SAME)
    last_new = first_new
    for number, word in enumerate(before.words):
        following = before.words[number + 1].start if number + 1 < len(before.words) else None
        pair = pairs.get(number)
        if pair is None:
            yield Stretched(word.start, word.end, last_new, last_new, Fit.GONE)
        else:
            other, fit = after.words[pair[0]], pair[1]
            yield from _word(_phones(before, word), _phones(after, other), (word, other), fit)
            last_new = other.end
        if following is None:
            yield Stretched(word.end, before.duration, _end(after), after.duration, Fit.SAME)
        elif following > word.end:
            until = last_new if pair is None else _next_start(after, pair[0])
            yield Stretched(word.end, following, last_new, until, Fit.GONE if pair is None else Fit.SAME)


def _word(
    phones: Sequence[Phone], others: Sequence[Phone], words: tuple[Word, Word], fit: Fit
) -> Iterator[Stretched]:
    if fit is Fit.SAME and phones and [p.symbol for p in phones] == [p.symbol for p in others]:
        for phone, other in zip(phones, others, strict=True):
            yield Stretched(phone.start, phone.end, other.start, other.end, fit)
    else:
        word, in_place = words
        yield Stretched(word.start, word.end, in_place.start, in_place.end, fit)


def _phones(utterance: Utterance, word: Word) -> Sequence[Phone]:
    return utterance.phones[word.first_phone : word.last_phone]


def _end(utterance: Utterance) -> float:
    return utterance.words[-1].end if utterance.words else 0.0


def _next_start(utterance: Utterance, number: int) -> float:
    words = utterance.words
    return words[number + 1].start if number + 1 < len(words) else utterance.duration


def _pairs(before: Sequence[Word], after: Sequence[Word]) -> dict[int, tuple[int, Fit]]:
    """Return for each word its number in the other line, if it is there."""
    one, two = [_plain(w) for w in before], [_plain(w) for w in after]
    pairs: dict[int, tuple[int, Fit]] = {}
    for kind, a, b, c, d in SequenceMatcher(None, one, two, autojunk=False).get_opcodes():
        if kind == "equal" or (kind == "replace" and b - a == d - c):
            fit = Fit.SAME if kind == "equal" else Fit.REPLACED
            pairs |= {a + k: (c + k, fit) for k in range(b - a)}
    return pairs


def _plain(word: Word) -> str:
    return "".join(c for c in word.text.casefold() if c.isalnum()) or word.text
