"""Pitch accents and boundary tones from the text (`rules/data/intonation.toml`), and those written by hand.

Content words are accented on the syllable that the engine stresses; the last accent of a phrase is its
nucleus. Measured against the pitch of a voice, either rule alone finds accents with an F1 near 0.73.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import replace
from typing import NamedTuple

from ...core.directions import UNDIRECTED, Directions, Tone
from ...core.utterance import Accent, Boundary, PauseKind, Utterance, Word
from ...rules.intonation import Candidate, Ending, intonation_table
from .. import phonesets
from ..text.english import function_words
from ..text.normalise import is_english
from ..text.tokens import APOSTROPHES
from .pauses import punctuation_kind

PRIMARY = 2
_PLAIN_APOSTROPHE = str.maketrans(dict.fromkeys(APOSTROPHES, "'"))
_ENDINGS = {
    PauseKind.COMMA: Ending.CONTINUATION,
    PauseKind.FULL_STOP: Ending.STATEMENT,
    PauseKind.EXCLAMATION: Ending.EXCLAMATION,
    PauseKind.HESITATION: Ending.HESITATION,
}
_SENTENCE_ENDS = (PauseKind.FULL_STOP, PauseKind.QUESTION, PauseKind.EXCLAMATION)


class _Phrase(NamedTuple):
    """Words [start, stop) and how they end."""

    start: int
    stop: int
    ends: Ending


def is_content_word(text: str) -> bool:
    """Tell whether a word is likely to be accented; words of other languages always are."""
    return text.lower().translate(_PLAIN_APOSTROPHE) not in function_words()


def intone(utterance: Utterance, directions: Directions = UNDIRECTED) -> Utterance:
    """Return the utterance with accents, each at the middle of its vowel, and the boundaries of its phrases.

    A phrase is a run of words without a pause between them, or up to a boundary written by hand; where
    accents are written by hand, its other words have none. One accent per phrase is nuclear. `directions`
    count characters of the utterance's text.
    """
    tones = _by_word(utterance.words, directions.accents)
    ends = _by_word(utterance.words, directions.boundaries)
    accents: list[Accent] = []
    boundaries: list[Boundary] = []
    for phrase in _phrases(utterance, ends):
        accents += _written(utterance, phrase, tones) or _ruled(utterance, phrase, directions)
        boundaries += _boundary(utterance, phrase, ends)
    return replace(utterance, accents=tuple(accents), boundaries=tuple(boundaries))


def _by_word(words: Sequence[Word], tones: Sequence[Tone]) -> dict[int, str]:
    """Return each tone's label by the index of the word that holds its character, or of the one before."""
    starts = [word.source_start for word in words]
    return {max(bisect_right(starts, tone.at) - 1, 0): tone.label for tone in tones}


def _phrases(utterance: Utterance, written: Mapping[int, str]) -> Iterator[_Phrase]:
    pauses = {pause.start: pause.kind for pause in utterance.pauses}
    first = 0
    for index, word in enumerate(utterance.words):
        last = index + 1 == len(utterance.words)
        if last or index in written or word.end in pauses:
            yield from _clauses(utterance, first, index + 1, _ending(utterance, index, pauses.get(word.end)))
            first = index + 1


def _ending(utterance: Utterance, index: int, pause: PauseKind | None) -> Ending:
    """Return how the phrase ends whose last word is number `index`, followed by a pause or by none."""
    if pause is PauseKind.HESITATION:
        return Ending.HESITATION
    kind = punctuation_kind(_after(utterance, index))
    if kind is PauseKind.QUESTION:
        return _question(utterance, index)
    if kind is not None:
        return _ENDINGS[kind]
    if index + 1 == len(utterance.words):
        return Ending.OPEN
    return Ending.CLAUSE if pause is None else Ending.PAUSE


def _after(utterance: Utterance, index: int) -> str:
    """Return the characters between a word and the next one."""
    following = utterance.words[index + 1 : index + 2]
    stop = following[0].source_start if following else len(utterance.text)
    return utterance.text[utterance.words[index].source_end : stop]


def _question(utterance: Utterance, last: int) -> Ending:
    """Return the kind of the question whose last word is number `last`; only English ones are told apart."""
    if not is_english(utterance.language):
        return Ending.YES_NO_QUESTION
    first = last
    while first and punctuation_kind(_after(utterance, first - 1)) not in _SENTENCE_ENDS:
        first -= 1
    words = [word.text.lower() for word in utterance.words[first : last + 1]]
    table = intonation_table().questions
    # "Well, what about Julia?", but not "Is it, when you can?"
    if any(word in table.wh for word in words[:2]):
        return Ending.WH_QUESTION
    return (
        Ending.ALTERNATIVE_QUESTION
        if any(w in table.alternative for w in words[1:-1])
        else Ending.YES_NO_QUESTION
    )


def _clauses(utterance: Utterance, start: int, stop: int, ends: Ending) -> Iterator[_Phrase]:
    """Yield words [start, stop) as one phrase, or several where English clauses begin within."""
    rule = intonation_table().clauses
    if is_english(utterance.language):
        for index in range(start + rule.least, stop - rule.least + 1):
            if utterance.words[index].text.lower() in rule.before and index - start >= rule.least:
                yield _Phrase(start, index, Ending.CLAUSE)
                start = index
    yield _Phrase(start, stop, ends)


def _written(utterance: Utterance, phrase: _Phrase, tones: Mapping[int, str]) -> list[Accent]:
    """Return the accents that are written by hand on words of the phrase."""
    words = [word for word in range(phrase.start, phrase.stop) if word in tones]
    placed = [(word, _strongest(utterance, range(word, word + 1))) for word in words]
    found = [(tones[word], syllable) for word, syllable in placed if syllable is not None]
    return [
        _accent(utterance, syllable, label, 1.0, nuclear=number == len(found))
        for number, (label, syllable) in enumerate(found, 1)
    ]


def _ruled(utterance: Utterance, phrase: _Phrase, directions: Directions) -> list[Accent]:
    """Return the accents that the rules find in a phrase."""
    candidates = _candidates(utterance, phrase, directions)
    found = [(syllable, intonation_table().accent_of(candidate)) for syllable, candidate in candidates]
    ruled = [(syllable, rule) for syllable, rule in found if rule is not None]
    return [
        _accent(utterance, syllable, str(rule.label), rule.confidence, nuclear=number == len(ruled))
        for number, (syllable, rule) in enumerate(ruled, 1)
    ]


def _candidates(utterance: Utterance, phrase: _Phrase, directions: Directions) -> list[tuple[int, Candidate]]:
    """Return the syllables of a phrase that might be accented, by their index."""
    words = range(phrase.start, phrase.stop)
    focused = {w for w in words if directions.focused(*_source(utterance.words[w]))}
    stressed = _stressed(utterance, words, focused)
    only = not stressed
    if only and (strongest := _strongest(utterance, words)) is not None:
        stressed = [strongest]
    word_of = {index: utterance.syllables[index].word for index in stressed}
    nucleus = max((i for i in stressed if word_of[i] in focused), default=max(stressed, default=-1))
    lexical = utterance.language.split("-")[0] in intonation_table().lexical.languages
    return [
        (
            index,
            Candidate(
                content=is_content_word(_text(utterance, index)),
                only=only,
                nuclear=index == nucleus,
                focus=word_of[index] in focused,
                after_focus=word_of[index] > min(focused, default=phrase.stop),
                ends=phrase.ends,
                lexical_tone=lexical,
            ),
        )
        for index in stressed
    ]


def _stressed(utterance: Utterance, words: range, focused: Set[int]) -> list[int]:
    """Return the stressed syllables of content words and of focused ones, each of which has at least one."""
    found = [
        index
        for index in _syllables(utterance, words)
        if utterance.syllables[index].stress == PRIMARY
        and (is_content_word(_text(utterance, index)) or utterance.syllables[index].word in focused)
    ]
    without = focused - {utterance.syllables[index].word for index in found}
    strongest = (_strongest(utterance, range(word, word + 1)) for word in without)
    return sorted([*found, *(index for index in strongest if index is not None)])


def _source(word: Word) -> tuple[int, int]:
    return word.source_start, word.source_end


def _text(utterance: Utterance, syllable: int) -> str:
    return utterance.words[utterance.syllables[syllable].word].text


def _syllables(utterance: Utterance, words: range) -> range:
    """Return the indices of all syllables of some words in a row."""
    first = bisect_left(utterance.syllables, words.start, key=lambda s: s.word)
    return range(first, bisect_left(utterance.syllables, words.stop, key=lambda s: s.word))


def _strongest(utterance: Utterance, words: range) -> int | None:
    """Return the most stressed syllable of some words, the last of several; None where there is none."""
    inside = _syllables(utterance, words)
    return max(inside, key=lambda index: (utterance.syllables[index].stress, index), default=None)


def _accent(utterance: Utterance, index: int, label: str, confidence: float, *, nuclear: bool) -> Accent:
    syllable = utterance.syllables[index]
    inside = utterance.phones[syllable.first_phone : syllable.last_phone]
    vowel = next(phone for phone in inside if phonesets.is_vowel(phone.symbol))
    return Accent(0.5 * (vowel.start + vowel.end), syllable.word, index, label, nuclear, confidence)


def _boundary(utterance: Utterance, phrase: _Phrase, written: Mapping[int, str]) -> Iterator[Boundary]:
    last = phrase.stop - 1
    end = utterance.words[last].end
    if last in written:
        yield Boundary(end, last, written[last])
    elif (rule := intonation_table().boundary_of(phrase.ends)) is not None:
        yield Boundary(end, last, rule.label, rule.confidence)
