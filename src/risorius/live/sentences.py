"""Split text that arrives in pieces into sentences.

Sentence boundaries do not depend on how the text is chunked.
"""

from __future__ import annotations

from itertools import pairwise, takewhile

from ..errors import InputError
from ..languages import Language
from ..speech.text.sentences import LIMIT, TextStretch, divide
from ..speech.text.tokens import is_speakable

LONGEST_WAITING = 100_000
"""Characters that may wait for the end of their sentence."""
# Characters after a possible end that decide whether the sentence ends there.
_LOOKAHEAD = 60
# A blank line ends a sentence that does not end in one of these.
_ENDS = ".!?\u2026"


class SentenceBuffer:
    """Collects text until a sentence is whole.

    A sentence is whole when the next one has begun, since "3." or "Dr." may not end one: `flush` ends the
    last. Sentences have the blanks after them, so that together they are the text that was added. Text longer
    than can be spoken at once is divided as offline.
    """

    def __init__(self, language: Language) -> None:
        self._language = language
        self._text = ""

    def __bool__(self) -> bool:
        return is_speakable(self._text)

    def add(self, text: str) -> list[str]:
        """Add a piece of text; return the sentences that are whole now.

        Raises InputError if too much text waits; the piece is not added then.
        """
        if len(self._text) + len(text) > LONGEST_WAITING:
            message = f"more than {LONGEST_WAITING:,} characters at once; expected text in smaller pieces"
            raise InputError(message)
        self._text += text
        stretches = divide(self._text, self._language)
        return self._take(list(takewhile(self._is_decided, stretches)))

    def flush(self) -> list[str]:
        """Return all that waits, as sentences; the last ends where it does, whatever follows."""
        sentences = self._take(list(divide(self._text, self._language)))
        if sentences:
            rest = sentences[-1].rstrip()
            sentences[-1] = rest + (" " if rest[-1] in _ENDS else "\n\n")
        self._text = ""
        return sentences

    def _is_decided(self, stretch: TextStretch) -> bool:
        if not stretch.ends_sentence:
            return len(self._text) >= stretch.start + LIMIT + _LOOKAHEAD
        following = self._text[stretch.end : stretch.end + _LOOKAHEAD]
        return len(following) == _LOOKAHEAD or any(character.isalnum() for character in following)

    def _take(self, stretches: list[TextStretch]) -> list[str]:
        edges = [0, *(self._after_blanks(stretch.end) for stretch in stretches)]
        sentences = [self._text[start:end] for start, end in pairwise(edges)]
        self._text = self._text[edges[-1] :]
        return sentences

    def _after_blanks(self, index: int) -> int:
        while self._text[index : index + 1].isspace():
            index += 1
        return index
