"""How a sentence asks, from its words."""

from __future__ import annotations

from collections.abc import Sequence

from ...core.utterance import Question
from ...rules.intonation import intonation_table
from ..text.normalise import is_english
from ..text.tokens import APOSTROPHES

# A sentence says how it asks with one of so many words.
_FIRST_WORDS = 2
_PLAIN_APOSTROPHE = str.maketrans(dict.fromkeys(APOSTROPHES, "'"))


def plain(text: str) -> str:
    """Return a word as lists of words have it: in lower case, with straight apostrophes."""
    return text.lower().translate(_PLAIN_APOSTROPHE)


def question_of(words: Sequence[str], language: str) -> Question:
    """Return the kind of the question that the words of a sentence ask; only English ones are told apart."""
    if not is_english(language):
        return Question.YES_NO
    texts = [plain(word) for word in words]
    table = intonation_table().questions
    # "Well, what about Julia?", but not "Is it, when you can?"
    if any(text in table.wh for text in texts[:_FIRST_WORDS]):
        return Question.WH
    if any(text in table.alternative for text in texts[1:-1]):
        return Question.ALTERNATIVE
    inverted = any(text in table.auxiliaries for text in texts[:_FIRST_WORDS])
    return Question.YES_NO if inverted else Question.UNMARKED
