"""Syllables: each vowel with as many consonants before it as can begin a word (maximal onset)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from ...core.speech.utterance import Phone, Syllable, Word
from ...languages import Language, phonesets


def syllabify(phones: Sequence[Phone], words: Sequence[Word], language: Language) -> tuple[Syllable, ...]:
    """Return the syllables of all words. A word without a vowel ("pst") has none."""
    return tuple(
        Syllable(first, last, phones[first].start, phones[last - 1].end, phones[nucleus].stress, index)
        for index, word in enumerate(words)
        for first, nucleus, last in _divide(phones, word.first_phone, word.last_phone, language)
    )


def _divide(
    phones: Sequence[Phone], first: int, last: int, language: Language
) -> Iterator[tuple[int, int, int]]:
    """Yield first phone, vowel and last phone (exclusive) of each syllable."""
    nuclei = [index for index in range(first, last) if phonesets.is_vowel(phones[index].symbol)]
    starts = [first, *(_onset(phones, a + 1, b, language) for a, b in pairwise(nuclei))]
    yield from zip(starts, nuclei, [*starts[1:], last], strict=False)


def _onset(phones: Sequence[Phone], first: int, vowel: int, language: Language) -> int:
    """Return where the onset of the vowel begins, at `first` or later."""
    for start in range(first, vowel):
        symbols = [phone.symbol for phone in phones[start:vowel]]
        if all(symbols) and _begins_a_word(
            [part for s in symbols for part in phonesets.to_arpabet(s)], language
        ):
            return start
    return vowel


def _begins_a_word(consonants: list[str], language: Language) -> bool:
    return consonants != ["NG"] if len(consonants) == 1 else tuple(consonants) in language.onsets
