"""Pauses and what they stand for, from the punctuation between the words around them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ...core.utterance import SILENCE, Pause, PauseKind, Phone, Word
from ...languages import Language, plain_word

# The punctuation that ends a text has a pause of at most so many seconds; the rest is the final pause.
PUNCTUATION_AT_END = 0.3
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

    Silence before the first word is INITIAL. After the last word comes the pause of its punctuation, for
    0.3 s at most and half of the silence, then FINAL for the rest. Elsewhere the punctuation between the
    words decides; without any, silence of at least 0.15 s is a COMMA. A comma after "um" and its like is a
    HESITATION. Silence inside a word is not a pause.
    """
    return tuple(
        pause for index in range(len(phones)) for pause in _pause(text, phones, words, index, language)
    )


def punctuation_kind(between: str) -> PauseKind | None:
    """Return what the characters between two words stand for, None where nothing asks for a pause."""
    for pattern, kind in _KINDS:
        if pattern.search(between):
            return kind
    return PauseKind.COMMA if _CLAUSE.search(between) else None


def _pause(
    text: str, phones: Sequence[Phone], words: Sequence[Word], index: int, language: Language
) -> Iterator[Pause]:
    phone = phones[index]
    if phone.symbol != SILENCE:
        return
    before = phones[index - 1].word if index else -1
    after = phones[index + 1].word if index + 1 < len(phones) else -1
    if before < 0:
        yield Pause(phone.start, phone.end, PauseKind.INITIAL)
    elif after < 0:
        yield from _at_end(phone, punctuation_kind(text[words[before].source_end :]))
    elif before != after:
        kind = punctuation_kind(text[words[before].source_end : words[after].source_start])
        if kind is None and phone.duration >= SHORTEST_UNASKED:
            kind = PauseKind.COMMA
        if kind is PauseKind.COMMA and plain_word(words[before].text) in language.fillers:
            kind = PauseKind.HESITATION
        if kind is not None:
            yield Pause(phone.start, phone.end, kind)


def _at_end(phone: Phone, kind: PauseKind | None) -> Iterator[Pause]:
    start = phone.start
    if kind is not None:
        start += min(PUNCTUATION_AT_END, 0.5 * phone.duration)
        yield Pause(phone.start, start, kind)
    yield Pause(start, phone.end, PauseKind.FINAL)
