"""Emotion in the voice: which words are spoken under which emotions (paper B, section 2.2)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from ..core.directions import DirectedSpan
from ..core.speech.utterance import Word
from ..core.speech.voice_style import PLAIN, VoiceAdjustment
from ..languages import Language
from ..rules.emotions import Display
from ..rules.voice_emotion import voice_manner
from ..script import Anchor, Script, SpokenLine
from ..script.anchor import Base
from .text.shape import worded

# Seconds of a word that is not spoken yet.
_STEP = 0.001


@dataclass(frozen=True, slots=True)
class Feeling:
    """Emotions by name with their intensities 0..1, from `start` to `end` (None: the very ends)."""

    intensities: Mapping[str, float]
    start: Anchor | None = None
    end: Anchor | None = None

    @property
    def throughout(self) -> bool:
        """Whether it colours everything that is said."""
        from_start = self.start is None or (self.start.base is Base.START and self.start.seconds == 0.0)
        return from_start and (self.end is None or (self.end.base is Base.END and self.end.seconds >= 0.0))

    @property
    def by_words(self) -> bool:
        """Whether the words' order alone says which of them lie within: both ends are edges of words."""
        return all(anchor is None or anchor.seconds == 0.0 for anchor in (self.start, self.end))

    def holds(self, word: Word, words: Sequence[Word], duration: float) -> bool:
        """Tell whether the middle of a word, one of `words` in `duration` seconds, lies within."""
        middle = 0.5 * (word.start + word.end)
        start = 0.0 if self.start is None else self.start.resolve(words, duration)
        end = None if self.end is None else self.end.resolve(words, duration)
        return start <= middle and (end is None or middle < end)


def feelings(script: Script, displays: Sequence[Display]) -> tuple[Feeling, ...]:
    """Return the emotions that a script marks and those displayed beside it."""
    marked = [Feeling(m.emotions, m.start, m.end) for m in script.marks if m.emotions]
    return (*marked, *(_displayed(display) for display in displays))


def _displayed(display: Display) -> Feeling:
    start, end = (None if at is None else Anchor(Base.START, at) for at in (display.start, display.end))
    return Feeling({display.emotion: display.intensity}, start, end)


def common_manner(felt: Sequence[Feeling]) -> VoiceAdjustment | None:
    """Return the manner of the whole if the emotions colour all of it, else None."""
    if not all(feeling.throughout for feeling in felt):
        return None
    return _manner(felt)


def coloured(script: Script, felt: Sequence[Feeling], words: Sequence[Word], duration: float) -> Script:
    """Return the script with each word's manner, found where `words` are, spoken plainly in `duration` s."""
    manners = [_manner([f for f in felt if f.holds(word, words, duration)]) for word in words]
    return replace(script, lines=tuple(_coloured_line(line, words, manners) for line in script.lines))


def written_words(script: Script, language: Language, variant: str) -> tuple[Word, ...]:
    """Return the words of a script that is not spoken yet: in their order, but a millisecond each.

    `variant`: the voice's language (BCP 47).
    """
    tokens = [
        (line.source_offset, token)
        for line in script.lines
        for token in worded(line.text, line.directions, language, variant).tokens
    ]
    return tuple(
        Word(token.text, number * _STEP, (number + 1) * _STEP, 0, 0, start + token.start, start + token.end)
        for number, (start, token) in enumerate(tokens)
    )


def _coloured_line(line: SpokenLine, words: Sequence[Word], manners: Sequence[VoiceAdjustment]) -> SpokenLine:
    spans = tuple(_spans(line, words, manners))
    return replace(line, directions=replace(line.directions, spans=(*spans, *line.directions.spans)))


def _spans(
    line: SpokenLine, words: Sequence[Word], manners: Sequence[VoiceAdjustment]
) -> Iterator[DirectedSpan]:
    first, last = line.source_offset, line.source_offset + len(line.text)
    inside = [(w, m) for w, m in zip(words, manners, strict=True) if first <= w.source_start < last]
    for manner, group in groupby(inside, key=lambda pair: pair[1]):
        run = [word for word, _ in group]
        if manner != PLAIN:
            yield DirectedSpan(run[0].source_start - first, run[-1].source_end - first, line.place, manner)


def _manner(felt: Sequence[Feeling]) -> VoiceAdjustment:
    intensities: dict[str, float] = {}
    for feeling in felt:
        for name, value in feeling.intensities.items():
            intensities[name] = max(intensities.get(name, 0.0), value)
    return voice_manner(intensities)
