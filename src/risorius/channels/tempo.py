"""The fullness of articulation of each stretch of speech, by its rate (`rules/data/lips.toml`, `tempo`)."""

from __future__ import annotations

from collections.abc import Iterator

from ..core.speech.utterance import SILENCE, Utterance
from ..rules.lips import LipTable

DIGITS = 2
"""Digits to which factors are rounded, so that phones of many stretches share their targets."""


def fullness_of_phones(utterance: Utterance, table: LipTable) -> list[float]:
    """Return the factor on the opening of each phone, shape (phones,): 1 in silence."""
    fullness = [1.0] * len(utterance.phones)
    for stretch in _stretches(utterance, table.pausing.shortest):
        phones = utterance.phones[stretch.start : stretch.stop]
        syllables = sum(phone.stress >= 0 for phone in phones)
        factor = table.tempo.fullness(syllables, phones[-1].end - phones[0].start, utterance.language)
        for index in stretch:
            fullness[index] = round(factor, DIGITS)
    return fullness


def _stretches(utterance: Utterance, shortest: float) -> Iterator[range]:
    """Yield the phones between silences of `shortest` seconds or more, and ends of sentences.

    Later words do not change the stretches of earlier sentences.
    """
    ends = {utterance.words[sentence.last_word - 1].last_phone for sentence in utterance.sentences}
    start = 0
    for index, phone in enumerate(utterance.phones):
        silent = phone.symbol == SILENCE and phone.duration >= shortest
        if (silent or index in ends) and start < index:
            yield range(start, index)
        if silent or index in ends:
            start = index + silent
    if start < len(utterance.phones):
        yield range(start, len(utterance.phones))
