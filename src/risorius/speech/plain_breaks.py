"""The breaks of a text in a voice without emotion: where its phrases end, whatever the voice feels.

Emotion changes neither the place nor the type of accents and boundaries (paper B, section 4.1). A slow voice
lengthens the short silences that an engine leaves in a sentence, and a fast one shortens them: only in the
plain voice do they tell where phrases end. Pauses stay those of the sound.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from ..languages import Language
from ..script import Script
from .assembly.assemble import SpokenText
from .structure.lines import TextLine, following_texts
from .structure.pauses import Breaks, breaks_of, find_pauses, punctuation_kind


def plain_breaks(
    script: Script, spoken: SpokenText, language: Language, speak_plainly: Callable[[Script], SpokenText]
) -> Breaks:
    """Return the breaks of the plain voice among the words of a script that was spoken with emotion.

    Silences that stand exactly where the punctuation does are breaks in every voice. Lines with others are
    spoken plainly for comparison; a line whose words come out otherwise keeps its own breaks.
    """
    breaks = breaks_of(
        find_pauses(spoken.text, spoken.phones, spoken.words, language, spoken.lines), spoken.words
    )
    following = following_texts(spoken.text, spoken.words, spoken.lines)
    unsure = [number for number, line in enumerate(spoken.lines) if _is_unsure(spoken, line, following)]
    if not unsure:
        return breaks
    lines = tuple(replace(script.lines[number], start=None) for number in unsure)
    plain = speak_plainly(replace(script, lines=lines, timed=False))
    found = find_pauses(plain.text, plain.phones, plain.words, language, plain.lines)
    plainly = breaks_of(found, plain.words)
    for number, line in zip(unsure, plain.lines, strict=True):
        own, theirs = spoken.lines[number].words(spoken.words), line.words(plain.words)
        if [spoken.words[i].source_start for i in own] == [plain.words[i].source_start for i in theirs]:
            for index, other in list(zip(own, theirs, strict=True))[:-1]:
                breaks.pop(index, None)
                if other in plainly:
                    breaks[index] = plainly[other]
    return breaks


def _is_unsure(spoken: SpokenText, line: TextLine, following: list[str]) -> bool:
    """Tell whether a line is silent anywhere but at its punctuation, or goes on there."""
    return any(silent != punctuated for silent, punctuated in _gaps(spoken, line, following))


def _gaps(spoken: SpokenText, line: TextLine, following: list[str]) -> Iterator[tuple[bool, bool]]:
    """Yield whether each gap between two words of a line is silent, and whether it is punctuated."""
    for index in line.words(spoken.words)[:-1]:
        silent = spoken.words[index].last_phone < spoken.words[index + 1].first_phone
        yield silent, punctuation_kind(following[index]) is not None
