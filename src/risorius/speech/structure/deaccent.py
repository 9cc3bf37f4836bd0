"""Content words that carry no accent where they stand, by the rules of their language."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence, Set
from functools import cache
from itertools import pairwise

from ...core.speech.utterance import Utterance
from ...languages import AccentPlaces, Language, Nouns, plain_word

_WITHIN = 2  # words before a noun among which its determiner stands


def deaccented(
    utterance: Utterance, language: Language, words: range, stressed: Sequence[int], focused: Set[int]
) -> set[int]:
    """Return those of the `stressed` syllables of a phrase, content words', that get no accent.

    `words` are those of the phrase. Words of `focused` keep their accents.
    """
    rules = language.accents
    texts = [utterance.words[word].text for word in words]
    content = sorted({utterance.syllables[index].word for index in stressed})
    silent = set(_trailing(rules, content, words, texts))
    silent |= set(_final_verb(language, [w for w in content if w not in silent], words, texts))
    silent |= set(_within_groups(rules, utterance, content))
    left = [index for index in stressed if utterance.syllables[index].word not in silent - focused]
    clashing = set(_clashing(left, utterance, focused)) if rules.clash else set()
    return set(stressed) - set(left) | clashing


def _trailing(
    rules: AccentPlaces, content: Sequence[int], words: range, texts: Sequence[str]
) -> Iterator[int]:
    """Yield words at the end that the nucleus passes over, if one is left for it: "a new book yesterday"."""
    for word in reversed(content[1:]):
        if plain_word(texts[word - words.start]) not in rules.trailing:
            return
        yield word


def _final_verb(
    language: Language, content: Sequence[int], words: range, texts: Sequence[str]
) -> Iterator[int]:
    """Yield the verb with which a phrase ends, if its object or the like stands before it: "Käse kaufen"."""
    if len(content) < 2:
        return
    last, noun = content[-1], content[-2]
    verb = texts[last - words.start]
    if last == words.stop - 1 and _is_verb(verb, language.accents) and _is_noun(noun, language, words, texts):
        yield last


def _is_verb(text: str, rules: AccentPlaces) -> bool:
    word = plain_word(text)
    lower = rules.nouns is not Nouns.CAPITALS or text[:1].islower()
    return lower and word not in rules.not_verbs and any(p.fullmatch(word) for p in _patterns(rules.verbs))


@cache
def _patterns(verbs: tuple[str, ...]) -> tuple[re.Pattern[str], ...]:
    return tuple(re.compile(re.escape(verb).replace("…", r"\w{2,}")) for verb in verbs)


def _is_noun(word: int, language: Language, words: range, texts: Sequence[str]) -> bool:
    at = word - words.start
    if language.accents.nouns is Nouns.CAPITALS:
        return texts[at][:1].isupper()
    before = map(plain_word, texts[max(at - _WITHIN, 0) : at])
    inflected = plain_word(texts[at]).endswith(language.accents.adjectives)
    return not inflected and any(text in language.accents.determiners for text in before)


def _within_groups(rules: AccentPlaces, utterance: Utterance, content: Sequence[int]) -> Iterator[int]:
    """Yield words that are not the last of their group: neighbours of at most `group` syllables in all."""
    if not rules.group:
        return
    syllables = 0
    for word, following in pairwise(content):
        syllables += sum(syllable.word == word for syllable in utterance.syllables)
        more = sum(syllable.word == following for syllable in utterance.syllables)
        if following == word + 1 and syllables + more <= rules.group:
            yield word
        else:
            syllables = 0


def _clashing(left: Sequence[int], utterance: Utterance, focused: Set[int]) -> Iterator[int]:
    """Yield syllables next to a following one that is accented, seen from the last one."""
    accented = None
    for index in reversed(left):
        if accented is not None and accented == index + 1 and utterance.syllables[index].word not in focused:
            yield index
        else:
            accented = index
