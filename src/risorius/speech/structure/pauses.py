"""Pauses and their meaning, from the punctuation between the words around them."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ...core.utterance import SILENCE, Pause, PauseKind, Phone, Word
from ...languages import Language, plain_word

# Shorter silence that no punctuation asks for is not a pause (seconds).
SHORTEST_UNASKED = 0.15

_KINDS = (
    (re.compile(r"[?\uff1f\u061f]"), PauseKind.QUESTION),
    (re.compile(r"[!\uff01]"), PauseKind.EXCLAMATION),
    (re.compile(r"\u2026|\.\.+"), PauseKind.HESITATION),
    (re.compile(r"[.\u3002\uff0e\u0964\u0965\u06d4]|\n\s*\n"), PauseKind.FULL_STOP),
)
_CLAUSE = re.compile(r"[,;:()\u2013\u2014\u060c\u3001\uff0c\uff1b\uff1a]|--|\s-\s|\n")


def find_pauses(
    text: str, phones: Sequence[Phone], words: Sequence[Word], language: Language
) -> tuple[Pause, ...]:
    """Return the pauses among `phones`, in order.

    Silence before the first word is INITIAL. Each later silence is one pause, of which the punctuation before
    it decides; without any, silence after the last word is FINAL, and of at least 0.15 s elsewhere a COMMA. A
    comma after "um" and its like is a HESITATION. Silence inside a word is not a pause.
    """
    pauses = (_pause(text, phones, words, index, language) for index in range(len(phones)))
    return tuple(pause for pause in pauses if pause is not None)


def punctuation_kind(between: str) -> PauseKind | None:
    """Return the kind of pause that the characters between two words ask for, None for no pause."""
    for pattern, kind in _KINDS:
        if pattern.search(between):
            return kind
    return PauseKind.COMMA if _CLAUSE.search(between) else None


def _pause(
    text: str, phones: Sequence[Phone], words: Sequence[Word], index: int, language: Language
) -> Pause | None:
    phone = phones[index]
    if phone.symbol != SILENCE:
        return None
    before = phones[index - 1].word if index else -1
    after = phones[index + 1].word if index + 1 < len(phones) else -1
    kind = _kind(text, phone, words, before, after, language)
    return None if kind is None else Pause(phone.start, phone.end, kind)


def _kind(
    text: str, phone: Phone, words: Sequence[Word], before: int, after: int, language: Language
) -> PauseKind | None:
    """Return the meaning of the silence between two words, by their index; -1: no word on that side."""
    if before < 0:
        return PauseKind.INITIAL
    if after < 0:
        return punctuation_kind(text[words[before].source_end :]) or PauseKind.FINAL
    if before == after:
        return None
    kind = punctuation_kind(text[words[before].source_end : words[after].source_start])
    if kind is None and phone.duration >= SHORTEST_UNASKED:
        kind = PauseKind.COMMA
    if kind is PauseKind.COMMA and plain_word(words[before].text) in language.fillers:
        return PauseKind.HESITATION
    return kind
