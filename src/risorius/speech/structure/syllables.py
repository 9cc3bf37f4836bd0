"""Syllables: each vowel with as many consonants before it as can begin an English word (maximal onset)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from ...core.utterance import Phone, Syllable, Word
from .. import phonesets

# Clusters that begin English words. One consonant alone may, but for NG.
_CLUSTERS = """
    P L, P R, P Y, B L, B R, B Y, T R, T W, T Y, D R, D W, D Y, K L, K R, K W, K Y, G L, G R, G W,
    F L, F R, F Y, V Y, TH R, TH W, SH R, HH Y, HH W, M Y, N Y, L Y, S P, S T, S K, S F, S M, S N, S L, S W,
    S Y, S P L, S P R, S P Y, S T R, S T Y, S K R, S K W, S K Y
"""
ONSETS = frozenset(tuple(cluster.split()) for cluster in _CLUSTERS.split(","))


def syllabify(phones: Sequence[Phone], words: Sequence[Word]) -> tuple[Syllable, ...]:
    """Return the syllables of all words. A word without a vowel ("pst") has none.

    Other languages are divided as English would divide the nearest English sounds.
    """
    return tuple(
        Syllable(first, last, phones[first].start, phones[last - 1].end, phones[nucleus].stress, index)
        for index, word in enumerate(words)
        for first, nucleus, last in _divide(phones, word.first_phone, word.last_phone)
    )


def _divide(phones: Sequence[Phone], first: int, last: int) -> Iterator[tuple[int, int, int]]:
    """Yield first phone, vowel and last phone (exclusive) of each syllable."""
    nuclei = [index for index in range(first, last) if phonesets.is_vowel(phones[index].symbol)]
    starts = [first, *(_onset(phones, a + 1, b) for a, b in pairwise(nuclei))]
    yield from zip(starts, nuclei, [*starts[1:], last], strict=False)


def _onset(phones: Sequence[Phone], first: int, vowel: int) -> int:
    """Return where the onset of the vowel begins, at `first` or later."""
    for start in range(first, vowel):
        symbols = [phone.symbol for phone in phones[start:vowel]]
        if all(symbols) and _begins_a_word([part for s in symbols for part in phonesets.to_arpabet(s)]):
            return start
    return vowel


def _begins_a_word(consonants: list[str]) -> bool:
    return consonants != ["NG"] if len(consonants) == 1 else tuple(consonants) in ONSETS
