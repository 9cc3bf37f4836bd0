"""Effects of the context on words: given ones, contrasted ones, and the new part of an answer.

Words that were said shortly before, or asked about, are given and lose their accents; what a question asks
for is new and keeps them (paper B, section 2.2.1, after Steedman 1991; Ladd 2008). The theme of an answer,
what it is about, is a phrase of its own if it is contrasted: "(JUlia prefers) (POPcorn)".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass, field
from itertools import takewhile
from typing import NamedTuple

from ...languages import Language, plain_word
from ..text.tokens import tokenize

# The number of sentences for which a word is given, and the number of words within which a repetition in the
# same sentence is a figure of speech ("hand in hand"). Both are ours.
_SENTENCES, _APART = 3, 3
# Most function words between a particle and the word that it contrasts.
_WITHIN = 3
THEME = "L-H%"
"""The tones that end the theme of an answer (Steedman 1991)."""


class PlacedWord(NamedTuple):
    """A word, the number of its sentence, and whether a comma or the like stands before it."""

    text: str
    sentence: int
    separated: bool


@dataclass(frozen=True, slots=True)
class DiscourseContext:
    """Indices of words. `given`: they lose their accents. `contrasted`: they have that of a contrast.

    `answer`: the function word that alone is new ("Who is it?" "*I* am"). `themes`: last words of themes.
    """

    given: Set[int] = frozenset()
    contrasted: Set[int] = frozenset()
    answer: int | None = None
    themes: Set[int] = frozenset()

    def moved(self, words: int) -> DiscourseContext:
        """Return the same context of words that stand this many words later."""
        sets = (frozenset(i + words for i in s) for s in (self.given, self.contrasted, self.themes))
        given_words, contrasted, themes = sets
        answer = None if self.answer is None else self.answer + words
        return DiscourseContext(given_words, contrasted, answer, themes)


@dataclass(frozen=True, slots=True)
class _Question:
    """Stems of a question: of all its words, of its topic, of the choices that it offers."""

    stems: Set[str] = frozenset()
    topics: Set[str] = frozenset()
    choices: Set[str] = frozenset()
    of_subject: bool = False


@dataclass(frozen=True, slots=True)
class _Line:
    """Words with their stems, and which of them have content."""

    words: Sequence[PlacedWord]
    stems: Sequence[str]
    content: Sequence[bool]
    language: Language = field(repr=False)

    def first_content(self, start: int) -> int | None:
        """Return the next content word from `start` on, with nothing but a few small words before it."""
        stop = min(start + _WITHIN, len(self.words))
        small = list(takewhile(lambda i: not self.content[i], range(start, stop)))
        at = start + len(small)
        pronouns = self.language.questions.pronouns
        if at >= stop or any(plain_word(self.words[i].text) in pronouns for i in small):
            return None
        return at if self.words[at].sentence == self.words[start - 1].sentence else None


def context_of(words: Sequence[PlacedWord], question: str, language: Language) -> DiscourseContext:
    """Return the effects of the context on words; the first sentence answers `question` if there is one."""
    if not language.spaces:
        return DiscourseContext()
    stems = [language.stem(word.text) for word in words]
    content = [not language.is_function_word(word.text) for word in words]
    line = _Line(words, stems, content, language)
    parsed = _read(question, language)
    contrasted = {*_corrected(line), *_taken_up(line, parsed)}
    given_words = {*_repeated(line), *_asked_about(line, parsed)} - contrasted
    new = [i for i in _first_sentence(line) if content[i] and i not in given_words]
    return DiscourseContext(
        frozenset(given_words),
        frozenset(contrasted),
        _new_function_word(line, parsed) if question and not new else None,
        frozenset(_themes(line, parsed, given_words, contrasted)),
    )


def _read(question: str, language: Language) -> _Question:
    """Return the stems of a question."""
    texts = [token.text for token in tokenize(question)]
    plain = [plain_word(text) for text in texts]
    stems = [language.stem(text) for text in texts]
    discourse = language.discourse
    topics = {
        stems[at + len(words)]
        for words in (phrase.split() for phrase in discourse.topics)
        for at in range(len(plain) - len(words))
        if plain[at : at + len(words)] == words and not language.is_function_word(texts[at + len(words)])
    }
    choices = {
        stems[i]
        for at, word in enumerate(plain)
        if word in language.questions.alternative
        for i in (_content_near(texts, at, -1, language), _content_near(texts, at, 1, language))
        if i is not None
    }
    return _Question(
        frozenset(stems), frozenset(topics), frozenset(choices), any(w in discourse.subjects for w in plain)
    )


def _content_near(texts: Sequence[str], at: int, step: int, language: Language) -> int | None:
    near = [i for i in range(at + step, at + step * (_WITHIN + 1), step) if 0 <= i < len(texts)]
    return next((i for i in near if not language.is_function_word(texts[i])), None)


def _first_sentence(line: _Line) -> Iterator[int]:
    return (i for i, word in enumerate(line.words) if word.sentence == line.words[0].sentence)


def _repeated(line: _Line) -> Iterator[int]:
    """Yield content words that were said shortly before, but not just now."""
    last: dict[str, int] = {}
    for index, (word, stem, content) in enumerate(zip(line.words, line.stems, line.content, strict=True)):
        if not content:
            continue
        before = last.get(stem)
        if before is not None:
            away = word.sentence - line.words[before].sentence
            if 1 <= away <= _SENTENCES or (away == 0 and index - before >= _APART):
                yield index
        last[stem] = index


def _asked_about(line: _Line, question: _Question) -> Iterator[int]:
    """Yield content words of the question in the sentences that follow it."""
    if not question.stems:
        return
    first = line.words[0].sentence
    for index, (word, stem, content) in enumerate(zip(line.words, line.stems, line.content, strict=True)):
        if content and stem in question.stems and word.sentence - first < _SENTENCES:
            yield index


def _taken_up(line: _Line, question: _Question) -> Iterator[int]:
    """Yield the words of the first sentence that a question turns to, or lets the speaker choose."""
    topics = set(question.topics | question.choices)
    for index in _first_sentence(line) if topics else ():
        if line.content[index] and line.stems[index] in topics:
            topics.discard(line.stems[index])
            yield index


def _corrected(line: _Line) -> Iterator[int]:
    """Yield words that are contrasted explicitly: "not tea but coffee", "tea, not coffee"."""
    for index, word in enumerate(line.words):
        if plain_word(word.text) not in line.language.discourse.negations:
            continue
        denied = line.first_content(index + 1)
        instead = None if denied is None else _instead(line, index, denied)
        if denied is not None and instead is not None:
            yield from (denied, instead)


def _instead(line: _Line, negation: int, denied: int) -> int | None:
    """Return the word that holds instead of the `denied` one: after a correction, or before the negation."""
    sentence, corrections = line.words[negation].sentence, line.language.discourse.corrections
    for index in range(denied + 1, len(line.words)):
        if line.words[index].sentence != sentence:
            break
        if plain_word(line.words[index].text) in corrections:
            return line.first_content(index + 1)
    before = range(negation - 1, max(negation - _WITHIN - 1, -1), -1)
    return next((i for i in before if line.content[i]), None) if line.words[negation].separated else None


def _new_function_word(line: _Line, question: _Question) -> int | None:
    """Return the function word that answers, which is not in the question.

    It is the first one if the question asks for a subject ("*I* did", "It's *me*"), else the last.
    """
    new = [i for i in _first_sentence(line) if line.stems[i] not in question.stems]
    whole = [i for i in new if "'" not in plain_word(line.words[i].text)] or new
    return None if not whole else whole[0] if question.of_subject else whole[-1]


def _themes(line: _Line, question: _Question, given_words: Set[int], contrasted: Set[int]) -> Iterator[int]:
    """Yield the last word of the theme that begins an answer, if contrasted and followed by something new."""
    if not question.topics:
        return
    old = given_words | contrasted
    first = list(_first_sentence(line))
    theme = list(takewhile(lambda i: i in old or not line.content[i], first))
    named = [i for i in theme if i in old]
    if len(theme) < len(first) and any(line.stems[i] in question.topics for i in named):
        yield named[-1]


def raised(context: DiscourseContext, words: Sequence[PlacedWord], language: Language) -> dict[int, float]:
    """Return by how many semitones a voice raises the words of an answer, its first sentence.

    The last new word and what is contrasted are raised as their tones are where they are written by hand,
    words that are given and follow it are lowered.
    """
    tones = language.intonation.voice.accents
    first = [i for i, word in enumerate(words) if word.sentence == words[0].sentence]
    content = [i for i in first if not language.is_function_word(words[i].text)]
    contrasted = context.contrasted | ({context.answer} if context.answer is not None else set())
    nucleus = max(
        (i for i in first if i in contrasted or (i in content and i not in context.given)), default=None
    )
    pitch = {i: tones["L+H*"] for i in first if i in contrasted}
    if nucleus is not None:
        pitch.setdefault(nucleus, tones["H*"])
        pitch |= {i: tones["L*"] for i in content if i > nucleus and i in context.given}
    return pitch
