"""Split text that arrives in pieces into sentences.

Sentence boundaries do not depend on how the text is chunked.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise, takewhile

from ..core.choices import MARKDOWN
from ..core.speech.characters import HIDDEN
from ..errors import InputError
from ..languages import Language
from ..script.markdown import UNMISTAKABLE, LeftOut, PlainText, kinds_of_marks, without_marks
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

    Text of the `format` Markdown becomes plain; without a format, from the second kind of its marks on, or
    the first that is never plain text, since what follows is not known. `tell` is told what is left out.
    """

    def __init__(
        self, language: Language, format: str | None = None, tell: Callable[[str], None] = lambda name: None
    ) -> None:
        self._language = language
        self._text = ""
        self._format, self._tell = format, tell
        self._kinds: frozenset[str] = frozenset()
        self._at_line_start = True

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
        plain = self._plain()
        stretches = divide(plain.text, self._language)
        return self._take(list(takewhile(partial(self._is_decided, plain.text), stretches)), plain)

    def flush(self) -> list[str]:
        """Return all that waits, as sentences; the last ends where it does, whatever follows."""
        plain = self._plain()
        sentences = self._take(list(divide(plain.text, self._language)), plain)
        self._tell_of(plain.left_out)
        if sentences:
            rest = sentences[-1].rstrip().rstrip(HIDDEN).rstrip()
            sentences[-1] = rest + (" " if rest[-1] in _ENDS else "\n\n")
        self._text, self._at_line_start = "", True
        return sentences

    def _plain(self) -> PlainText:
        """Return the text without Markdown's marks; its characters stay at their places."""
        if self._format is None:
            self._kinds |= kinds_of_marks(self._text)
        if self._format == MARKDOWN or len(self._kinds) > 1 or self._kinds & UNMISTAKABLE:
            return without_marks(self._text, at_line_start=self._at_line_start)
        return PlainText(self._text, ())

    def _is_decided(self, text: str, stretch: TextStretch) -> bool:
        if not stretch.ends_sentence:
            return len(text) >= stretch.start + LIMIT + _LOOKAHEAD
        following = text[stretch.end : stretch.end + _LOOKAHEAD]
        return len(following) == _LOOKAHEAD or any(character.isalnum() for character in following)

    def _take(self, stretches: list[TextStretch], plain: PlainText) -> list[str]:
        edges = [0, *(self._after_blanks(stretch.end) for stretch in stretches)]
        sentences = [plain.text[start:end] for start, end in pairwise(edges)]
        self._tell_of([part for part in plain.left_out if part.at < edges[-1]])
        if edges[-1]:
            self._at_line_start = self._text[edges[-1] - 1] == "\n"
        self._text = self._text[edges[-1] :]
        return sentences

    def _tell_of(self, left_out: Sequence[LeftOut]) -> None:
        for name in dict.fromkeys(part.name for part in left_out):
            self._tell(name)

    def _after_blanks(self, index: int) -> int:
        while self._text[index : index + 1].isspace():
            index += 1
        return index
