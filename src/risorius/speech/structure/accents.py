"""Pitch accents and boundary tones: from the text, by its language's rules, and those written by hand.

Content words are accented on the syllable that the engine stresses, but those that their language passes over
(`deaccent`) and those that are given (`context`); the last accent of a phrase is its nucleus. Measured
against the pitch of a voice, either rule alone finds accents with an F1 near 0.73.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import replace

from ...core.directions import Directions, ToneMark
from ...core.speech.utterance import Accent, Boundary, Phrase, Utterance, Word
from ...languages import Language, language_of, phonesets
from ...languages.intonation import Candidate
from .context import THEME, DiscourseContext, PlacedWord, context_of
from .deaccent import deaccented
from .lines import TextLine, following_texts, whole
from .pauses import Breaks
from .phrases import find_phrases

PRIMARY = 2


def intone(utterance: Utterance, lines: Sequence[TextLine] = (), breaks: Breaks | None = None) -> Utterance:
    """Return the utterance with its phrases, their accents, each at the middle of its vowel, and boundaries.

    A phrase also ends with a boundary that is written by hand; if accents are, its other words have none. One
    accent per phrase is nuclear. Without `lines` the text is one. `breaks`: as in `find_phrases`.
    """
    lines = lines or (whole(utterance.text, utterance.phones),)
    tones = _by_word(utterance.words, [(line, line.directions.accents) for line in lines])
    ends = _by_word(utterance.words, [(line, line.directions.boundaries) for line in lines])
    language = language_of(utterance.language)
    phrases = find_phrases(utterance, ends, clauses=True, lines=lines, breaks=breaks)
    contexts = _contexts(utterance, language, phrases, lines)
    themes = {word: THEME for context in contexts for word in context.themes if word not in ends}
    if themes:
        ends = themes | ends
        phrases = find_phrases(utterance, ends, clauses=True, lines=lines, breaks=breaks)
    accents: list[Accent] = []
    boundaries: list[Boundary] = []
    last_words = [line.words(utterance.words).stop for line in lines]
    for phrase in phrases:
        number = bisect_right(last_words, phrase.first_word)
        accents += _written(utterance, phrase, tones) or _ruled(
            utterance, language, phrase, lines[number].directions, contexts[number]
        )
        boundaries += _boundary(utterance, language, phrase, ends)
    return replace(utterance, accents=tuple(accents), boundaries=tuple(boundaries), phrases=phrases)


def _contexts(
    utterance: Utterance, language: Language, phrases: Sequence[Phrase], lines: Sequence[TextLine]
) -> list[DiscourseContext]:
    """Return the context of each line: nothing is given by another one."""
    sentences = [p.sentence for p in phrases for _ in range(p.first_word, p.last_word)]
    separated = [bool(text.strip()) for text in following_texts(utterance.text, utterance.words, lines)]
    contexts = []
    for line in lines:
        words = line.words(utterance.words)
        placed = [
            PlacedWord(utterance.words[i].text, sentences[i], separated=i > words.start and separated[i - 1])
            for i in words
        ]
        contexts.append(context_of(placed, line.directions.answers, language).moved(words.start))
    return contexts


def _by_word(words: Sequence[Word], tones: Sequence[tuple[TextLine, Sequence[ToneMark]]]) -> dict[int, str]:
    """Return each tone's label by the index of the word of its line that holds its character, or of the one
    before.
    """
    starts = [word.source_start for word in words]
    return {
        max(bisect_right(starts, tone.at) - 1, line.words(words).start): tone.label
        for line, own in tones
        for tone in own
    }


def _written(utterance: Utterance, phrase: Phrase, tones: Mapping[int, str]) -> list[Accent]:
    """Return the accents that are written by hand on words of the phrase."""
    words = [word for word in range(phrase.first_word, phrase.last_word) if word in tones]
    placed = [(word, _strongest(utterance, range(word, word + 1))) for word in words]
    accented = [(tones[word], syllable) for word, syllable in placed if syllable is not None]
    return [
        _accent(utterance, syllable, label, 1.0, nuclear=number == len(accented))
        for number, (label, syllable) in enumerate(accented, 1)
    ]


def _ruled(
    utterance: Utterance,
    language: Language,
    phrase: Phrase,
    directions: Directions,
    context: DiscourseContext,
) -> list[Accent]:
    """Return the accents that the rules find in a phrase."""
    candidates = _candidates(utterance, language, phrase, directions, context)
    judged = [(syllable, language.intonation.accent_of(candidate)) for syllable, candidate in candidates]
    ruled = [(syllable, rule) for syllable, rule in judged if rule is not None]
    return [
        _accent(utterance, syllable, str(rule.label), rule.confidence, nuclear=number == len(ruled))
        for number, (syllable, rule) in enumerate(ruled, 1)
    ]


def _candidates(
    utterance: Utterance,
    language: Language,
    phrase: Phrase,
    directions: Directions,
    context: DiscourseContext,
) -> list[tuple[int, Candidate]]:
    """Return the syllables of a phrase that might be accented, by their index."""
    words = range(phrase.first_word, phrase.last_word)
    focused = {w for w in words if w == context.answer or directions.focused(*_source(utterance.words[w]))}
    stressed = _stressed(utterance, language, words, focused)
    only = not stressed
    if only and (strongest := _strongest(utterance, words)) is not None:
        stressed = [strongest]
    word_of = {index: utterance.syllables[index].word for index in stressed}
    silent = set() if only else _silent(utterance, language, words, stressed, focused, context)
    last = max((index for index in stressed if index not in silent), default=-1)
    nucleus = max((i for i in stressed if word_of[i] in focused), default=last)
    return [
        (
            index,
            Candidate(
                content=not language.is_function_word(_text(utterance, index)),
                only=only,
                nuclear=index == nucleus,
                focus=word_of[index] in focused,
                after_focus=word_of[index] > min(focused, default=phrase.last_word),
                ends=phrase.ending,
                lexical_tone=language.tones,
                deaccented=index in silent,
                contrast=word_of[index] in context.contrasted,
            ),
        )
        for index in stressed
    ]


def _silent(
    utterance: Utterance,
    language: Language,
    words: range,
    stressed: Sequence[int],
    focused: Set[int],
    context: DiscourseContext,
) -> set[int]:
    """Return the syllables that get no accent: by the language's rules, and those of given words.

    A phrase of which nothing else is left is accented as if nothing were given.
    """
    prominent = focused | context.contrasted
    unaccented = {i for i in stressed if utterance.syllables[i].word in context.given - prominent}
    left = [i for i in stressed if i not in unaccented]
    if not left:
        return deaccented(utterance, language, words, stressed, prominent)
    return unaccented | deaccented(utterance, language, words, left, prominent)


def _stressed(utterance: Utterance, language: Language, words: range, focused: Set[int]) -> list[int]:
    """Return the stressed syllables of content words and of focused ones, each of which has at least one."""
    syllables = [
        index
        for index in _syllables(utterance, words)
        if utterance.syllables[index].stress == PRIMARY
        and (
            utterance.syllables[index].word in focused
            or not language.is_function_word(_text(utterance, index))
        )
    ]
    without = focused - {utterance.syllables[index].word for index in syllables}
    strongest = (_strongest(utterance, range(word, word + 1)) for word in without)
    return sorted([*syllables, *(index for index in strongest if index is not None)])


def _source(word: Word) -> tuple[int, int]:
    return word.source_start, word.source_end


def _text(utterance: Utterance, syllable: int) -> str:
    return utterance.words[utterance.syllables[syllable].word].text


def _syllables(utterance: Utterance, words: range) -> range:
    """Return the indices of all syllables of some words in a row."""
    first = bisect_left(utterance.syllables, words.start, key=lambda s: s.word)
    return range(first, bisect_left(utterance.syllables, words.stop, key=lambda s: s.word))


def _strongest(utterance: Utterance, words: range) -> int | None:
    """Return the most stressed syllable of some words, the last of several; None if they have none."""
    inside = _syllables(utterance, words)
    return max(inside, key=lambda index: (utterance.syllables[index].stress, index), default=None)


def _accent(utterance: Utterance, index: int, label: str, confidence: float, *, nuclear: bool) -> Accent:
    syllable = utterance.syllables[index]
    inside = utterance.phones[syllable.first_phone : syllable.last_phone]
    vowel = next(phone for phone in inside if phonesets.is_vowel(phone.symbol))
    return Accent(0.5 * (vowel.start + vowel.end), syllable.word, index, label, nuclear, confidence)


def _boundary(
    utterance: Utterance, language: Language, phrase: Phrase, written: Mapping[int, str]
) -> Iterator[Boundary]:
    last = phrase.last_word - 1
    end = utterance.words[last].end
    if last in written:
        yield Boundary(end, last, written[last])
    elif (rule := language.intonation.boundary_of(phrase.ending)) is not None:
        yield Boundary(end, last, rule.label, rule.confidence)
