"""The kind of question that a sentence asks, from its words."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import dropwhile

from ...core.speech.utterance import Question
from ...languages import Language, Questions, plain_word

# The first words of a sentence among which its question word is sought.
_FIRST_WORDS = 2


class _Line:
    """Words in a row; without blanks between them, a sought word may be a part of one."""

    def __init__(self, words: Sequence[str], spaces: bool) -> None:
        self._blank = " " if spaces else ""
        self._text = self._blank + self._blank.join(words) + self._blank

    def holds(self, text: str) -> bool:
        return self._bounded(text) in self._text

    def ends(self, text: str) -> bool:
        return self._text.endswith(self._bounded(text))

    def divided_by(self, text: str) -> bool:
        """Tell whether a text stands between others."""
        at = self._text.find(self._bounded(text), 1)
        return at > 0 and not self.ends(text)

    def _bounded(self, text: str) -> str:
        return self._blank + text + self._blank


def question_of(words: Sequence[str], language: Language) -> Question:
    """Return the kind of the question that the words of a sentence ask."""
    table = language.questions
    texts = list(dropwhile(table.openers.__contains__, map(plain_word, words)))
    line = _Line(texts, language.spaces)
    if any(map(line.ends, table.last_yes_no)):
        return Question.YES_NO
    kind = _by_first_words(texts, table)
    if kind is None and (_is_inverted(texts, language) or _is_tagged(texts, table)):
        kind = Question.YES_NO
    asks = any(map(line.ends, table.last)) or any(map(line.holds, table.anywhere))
    if kind is Question.WH or (kind is None and asks):
        return Question.WH
    if any(map(line.divided_by, table.alternative)):
        return Question.ALTERNATIVE
    return kind or table.otherwise


def _by_first_words(texts: Sequence[str], table: Questions) -> Question | None:
    """Return the kind of question that the first telling word asks; None if no word tells.

    "Now, what about Julia?", but not "Is it, when you can?"; "Is Peter there?" and "Peter, is he there?", but
    not "Peter is there?"
    """
    for number, text in enumerate(texts[:_FIRST_WORDS]):
        if any(part in table.wh for part in (text, *text.split("'"))):
            return Question.WH
        asks = number == 0 or _before_subject(texts, number, table)
        if (text in table.yes_no and asks) or _holds_subject(text, table):
            return Question.YES_NO
    return None


def _before_subject(texts: Sequence[str], number: int, table: Questions) -> bool:
    """Tell whether a word stands between something that is not its subject and a pronoun that is."""
    follows = number + 1 < len(texts) and texts[number + 1] in table.pronouns
    return follows and texts[number - 1] not in table.subjects


def _is_inverted(texts: Sequence[str], language: Language) -> bool:
    """Tell whether a verb stands before its subject: "Kommst du?", "Jean vient-il ?"."""
    table = language.questions
    subject_follows = table.verb_first and len(texts) > 1 and texts[1] in table.subjects
    verb_first = subject_follows and not language.is_function_word(texts[0])
    return verb_first or any(_holds_subject(text, table) for text in texts)


def _is_tagged(texts: Sequence[str], table: Questions) -> bool:
    """Tell whether a statement ends with a question of two words: "He did it, didn't he?"."""
    ends = table.tags and len(texts) > 2
    return ends and texts[-2] in table.yes_no and texts[-1] in table.pronouns


def _holds_subject(text: str, table: Questions) -> bool:
    """Tell whether a word is a verb that a hyphen joins to its subject: "viens-tu"."""
    return "-" in text and text.rsplit("-", 1)[1] in table.hyphenated
