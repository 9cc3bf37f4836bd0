"""From phones and words to an utterance: its syllables, pauses, phrases, accents and marks, in this order."""

from __future__ import annotations

from collections.abc import Sequence

from ...core.speech.audio import Audio
from ...core.speech.utterance import Phone, Utterance, Word
from ...languages import language_of
from .accents import intone
from .lines import TextLine
from .marks import with_marks
from .pauses import Breaks, find_pauses
from .syllables import syllabify


def build_utterance(
    text: str,
    code: str,
    audio: Audio,
    phones: tuple[Phone, ...],
    words: tuple[Word, ...],
    lines: Sequence[TextLine] = (),
    breaks: Breaks | None = None,
) -> Utterance:
    """Return the utterance of a text in the language `code`; without `lines` the text is one.

    `breaks`: the pauses that end phrases, if they are not those of the sound.
    """
    language = language_of(code)
    syllables = syllabify(phones, words, language)
    pauses = find_pauses(text, phones, words, language, lines)
    utterance = intone(Utterance(text, code, audio, phones, words, syllables, pauses), lines, breaks)
    return with_marks(utterance, lines)
