"""Pauses and their meaning, from the punctuation between the words around them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence, Set

from ...core.speech.utterance import SILENCE, Pause, PauseKind, Phone, Word
from ...languages import Language, plain_word
from .lines import TextLine, following_texts

# Shorter silence that no punctuation asks for is not a pause (seconds).
SHORTEST_UNASKED = 0.15

_KINDS = (
    (re.compile(r"[?\uff1f\u061f]"), PauseKind.QUESTION),
    (re.compile(r"[!\uff01]"), PauseKind.EXCLAMATION),
    (re.compile(r"\u2026|\.\.+"), PauseKind.HESITATION),
    (re.compile(r"[.\u3002\uff0e\u0964\u0965\u06d4]|\u2029|\n\s*\n"), PauseKind.FULL_STOP),
)
_CLAUSE = re.compile(r"[,;:()\u2013\u2014\u060c\u3001\uff0c\uff1b\uff1a]|--|\s-\s|\n")


Breaks = Mapping[int, PauseKind]
"""The kind of the pause after each word that has one, by the word's index."""


def breaks_of(pauses: Sequence[Pause], words: Sequence[Word]) -> dict[int, PauseKind]:
    """Return the breaks that pauses make among words."""
    kinds = {pause.start: pause.kind for pause in pauses}
    return {index: kinds[word.end] for index, word in enumerate(words) if word.end in kinds}


def find_pauses(
    text: str,
    phones: Sequence[Phone],
    words: Sequence[Word],
    language: Language,
    lines: Sequence[TextLine] = (),
) -> tuple[Pause, ...]:
    """Return the pauses among `phones`, in order.

    Silence before the first word is INITIAL. Each later silence is one pause, of which the punctuation before
    it decides; without any, silence after the last word is FINAL, and of at least 0.15 s elsewhere a COMMA. A
    comma after "um" and its like is a HESITATION. Silence inside a word is not a pause. All silence between
    two lines is one pause: a full stop, unless the first line ends in a silence after other punctuation.
    """
    following = following_texts(text, words, lines)
    edges = {index for line in lines for index in (line.phones.start, line.phones.stop)}
    pauses: list[Pause] = []
    spoken = False
    for index, phone in enumerate(phones):
        if phone.symbol != SILENCE:
            spoken = True
            continue
        kind = _kind(phones, words, index, edges, following, language)
        if kind is None:
            continue
        pause = Pause(phone.start, phone.end, kind)
        if index in edges:
            pause = _before_line(pauses, pause, PauseKind.FULL_STOP if spoken else PauseKind.INITIAL)
        pauses.append(pause)
    return tuple(pauses)


def _before_line(pauses: list[Pause], pause: Pause, kind: PauseKind) -> Pause:
    """Return a pause before a line, of this kind; it takes in the one that leads to it, and its function."""
    if not pauses or pauses[-1].end != pause.start:
        return Pause(pause.start, pause.end, kind)
    before = pauses.pop()
    return Pause(before.start, pause.end, kind if before.kind is PauseKind.FINAL else before.kind)


def punctuation_kind(between: str) -> PauseKind | None:
    """Return the kind of pause that the characters between two words ask for, None for no pause."""
    for pattern, kind in _KINDS:
        if pattern.search(between):
            return kind
    return PauseKind.COMMA if _CLAUSE.search(between) else None


def _kind(
    phones: Sequence[Phone],
    words: Sequence[Word],
    index: int,
    edges: Set[int],
    following: Sequence[str],
    language: Language,
) -> PauseKind | None:
    """Return the meaning of a silence, by its index, in its line; `edges` are the first phones of lines."""
    before = phones[index - 1].word if index and index not in edges else -1
    after = phones[index + 1].word if index + 1 < len(phones) and index + 1 not in edges else -1
    if before < 0:
        return PauseKind.INITIAL
    if after < 0:
        return punctuation_kind(following[before]) or PauseKind.FINAL
    if before == after:
        return None
    kind = punctuation_kind(following[before])
    if kind is None and phones[index].duration >= SHORTEST_UNASKED:
        kind = PauseKind.COMMA
    if kind is PauseKind.COMMA and plain_word(words[before].text) in language.fillers:
        return PauseKind.HESITATION
    return kind
