"""The speaker's state in a script: emotions felt, what is said of what, and when the other one speaks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..core.speech.utterance import Word
from ..rules.emotions import Display
from ..rules.situation import PartSpan
from .model import Mark, MarkKind, Script


def felt_in(script: Script, words: Sequence[Word], duration: float) -> tuple[Display, ...]:
    """Return the emotions that the script marks as felt, with their spans in seconds."""
    return tuple(display for mark in script.marks for display in _displays(mark, words, duration))


def _displays(mark: Mark, words: Sequence[Word], duration: float) -> Iterator[Display]:
    start, end = mark.start.resolve(words, duration), mark.end.resolve(words, duration)
    for name, intensity in mark.emotions.items():
        yield Display(name, intensity, start, end)


def listening_in(script: Script, words: Sequence[Word], duration: float) -> tuple[tuple[float, float], ...]:
    """Return the spans of listening in order, seconds; one that is marked twice counts once."""
    spans = {
        (mark.start.resolve(words, duration), mark.end.resolve(words, duration))
        for mark in script.marks
        if mark.kind is MarkKind.LISTEN
    }
    return tuple(sorted(spans))


def information_in(script: Script, words: Sequence[Word], duration: float) -> tuple[PartSpan, ...]:
    """Return the themes and rhemes that the script marks, with their spans in seconds, in order."""
    spans = (
        PartSpan(m.part, m.start.resolve(words, duration), m.end.resolve(words, duration))
        for m in script.information
    )
    return tuple(sorted(spans, key=lambda span: (span.start, span.end, span.part)))
