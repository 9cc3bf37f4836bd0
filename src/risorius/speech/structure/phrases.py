"""Phrases and sentences, with their ends and kinds of question. They are found here and nowhere else."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Collection, Iterator, Sequence, Set
from dataclasses import dataclass, replace
from itertools import pairwise

from ...core.speech.utterance import SENTENCE_ENDS, Ending, PauseKind, Phrase, Question, Utterance
from ...languages import Language, language_of, plain_word
from ..text.sentences import divide
from .lines import TextLine, following_texts, whole
from .pauses import Breaks, breaks_of, punctuation_kind
from .questions import question_of

_ENDINGS = {
    PauseKind.COMMA: Ending.CONTINUATION,
    PauseKind.FULL_STOP: Ending.STATEMENT,
    PauseKind.EXCLAMATION: Ending.EXCLAMATION,
    PauseKind.HESITATION: Ending.HESITATION,
}
# The sign before a question in Spanish.
_OPENING = "\u00bf"
_QUESTION_ENDINGS = {
    Question.WH: Ending.WH_QUESTION,
    Question.ALTERNATIVE: Ending.ALTERNATIVE_QUESTION,
}


@dataclass(frozen=True, slots=True)
class _Text:
    """An utterance as it is written: `following` are the characters after each word.

    `breaks`: the kind of the pause after each word that has one. `sentences`: the first word of each;
    `line_ends`: the last word of each line.
    """

    utterance: Utterance
    language: Language
    following: Sequence[str]
    breaks: Breaks
    sentences: Sequence[int]
    line_ends: Set[int]


def with_phrases(utterance: Utterance) -> Utterance:
    """Return the utterance with its phrases: runs of words up to a pause, a boundary or a sentence's end."""
    return replace(utterance, phrases=find_phrases(utterance, {b.word for b in utterance.boundaries}))


def find_phrases(
    utterance: Utterance,
    last_words: Collection[int],
    *,
    clauses: bool = False,
    lines: Sequence[TextLine] = (),
    breaks: Breaks | None = None,
) -> tuple[Phrase, ...]:
    """Return the phrases of an utterance, in order.

    A phrase ends at a pause, with a sentence, and with one of `last_words`; if `clauses`, also before a word
    with which a clause begins, though nothing is heard there. A sentence ends with its line. `breaks`: the
    pauses that count, by the word before, if they are not those of the sound.
    """
    words = utterance.words
    if breaks is None:
        breaks = breaks_of(utterance.pauses, words)
    text = _text_of(utterance, lines or (whole(utterance.text, utterance.phones),), breaks)
    sentences = text.sentences
    sentence_ends = {*sentences, len(words)}
    ends = [
        index
        for index in range(len(words))
        if index + 1 in sentence_ends or index in last_words or index in breaks
    ]
    phrases: list[Phrase] = []
    for before, last in pairwise([-1, *ends]):
        number = bisect_right(sentences, last) - 1
        stop = sentences[number + 1] if number + 1 < len(sentences) else len(words)
        question = _question(text, sentences[number], stop - 1)
        edges = [
            before + 1,
            *(_clause_starts(text, before + 1, last + 1) if clauses else ()),
            last + 1,
        ]
        for first, end in pairwise(edges):
            ending = Ending.CLAUSE if end <= last else _ending(text, sentences[number], last)
            times = (words[first].start, words[end - 1].end)
            phrases.append(Phrase(first, end, *times, number, ending, question))
    return tuple(phrases)


def _text_of(utterance: Utterance, lines: Sequence[TextLine], breaks: Breaks) -> _Text:
    language = language_of(utterance.language)
    following = following_texts(utterance.text, utterance.words, lines)
    line_ends = {line.words(utterance.words).stop - 1 for line in lines}
    sentences = _sentence_starts(utterance, language, lines, breaks)
    return _Text(utterance, language, following, breaks, sentences, line_ends)


def _sentence_starts(
    utterance: Utterance, language: Language, lines: Sequence[TextLine], breaks: Breaks
) -> list[int]:
    """Return the first word of each sentence."""
    texts = [(c.start, utterance.text[c.start : c.stop]) for c in (line.characters for line in lines)]
    cuts = [start + s.end for start, text in texts for s in divide(text, language) if s.ends_sentence]
    numbers = [bisect_right(cuts, word.source_start) for word in utterance.words]
    return [
        index
        for index, number in enumerate(numbers)
        if index == 0 or number != numbers[index - 1] or breaks.get(index - 1) in SENTENCE_ENDS
    ]


def _question(text: _Text, first: int, last: int) -> Question:
    """Return how the words from `first` to `last` ask, with which a sentence may end."""
    if punctuation_kind(text.following[last]) is not PauseKind.QUESTION:
        return Question.NONE
    words = text.utterance.words[_opening(text, first, last) : last + 1]
    return question_of([word.text for word in words], text.language)


def _opening(text: _Text, first: int, last: int) -> int:
    """Return the first word of the question among [first, last], which Spanish marks: "Hola, ¿qué tal?"."""
    marked = (i for i in range(last, first, -1) if _OPENING in text.following[i - 1])
    return next(marked, first)


def _ending(text: _Text, sentence: int, last: int) -> Ending:
    """Return how the phrase with the last word `last` ends; its sentence starts with the word `sentence`."""
    pause = text.breaks.get(last)
    if pause is PauseKind.HESITATION:
        return Ending.HESITATION
    kind = punctuation_kind(text.following[last])
    if kind is PauseKind.QUESTION:
        return _QUESTION_ENDINGS.get(_question(text, sentence, last), Ending.YES_NO_QUESTION)
    if kind is not None:
        return _ENDINGS[kind]
    if last in text.line_ends:
        return Ending.OPEN
    return Ending.CLAUSE if pause is None else Ending.PAUSE


def _clause_starts(text: _Text, start: int, stop: int) -> Iterator[int]:
    """Yield the words among [start, stop) with which clauses begin."""
    rule = text.language.clauses
    for index in range(start + rule.least, stop - rule.least + 1):
        if plain_word(text.utterance.words[index].text) in rule.before and index - start >= rule.least:
            yield index
            start = index
