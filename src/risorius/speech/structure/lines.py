"""The lines of an utterance: what is spoken in one go, where neither a sentence nor its context goes on."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass

from ...core.directions import UNDIRECTED, Directions
from ...core.speech.utterance import Phone, Word


@dataclass(frozen=True, slots=True)
class TextLine:
    """A line of an utterance: the indices of its phones and of its characters, which `directions` count.

    Phones between two lines are silent.
    """

    phones: range
    characters: range
    directions: Directions = UNDIRECTED

    def words(self, words: Sequence[Word]) -> range:
        """Return which of the words of the utterance are the line's, by their indices."""
        first, last = (
            bisect_left(words, at, key=lambda word: word.source_start)
            for at in (self.characters.start, self.characters.stop)
        )
        return range(first, last)


def whole(text: str, phones: Sequence[Phone], directions: Directions = UNDIRECTED) -> TextLine:
    """Return a whole text as one line."""
    return TextLine(range(len(phones)), range(len(text)), directions)


def following_texts(text: str, words: Sequence[Word], lines: Sequence[TextLine] = ()) -> list[str]:
    """Return the characters after each word, up to the next word or to the end of its line.

    Without `lines` the text is one.
    """
    stops = [*(word.source_start for word in words[1:]), len(text)]
    for line in lines:
        last = line.words(words).stop - 1
        if last >= 0:
            stops[last] = line.characters.stop
    return [text[word.source_end : stop] for word, stop in zip(words, stops, strict=False)]
