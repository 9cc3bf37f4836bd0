"""`.TextGrid`: words, phones, accents and boundaries for Praat and aligners; as a script it is read again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path

from ...core.speech.utterance import NamedTime, Phone, Utterance
from ...errors import OutputError
from ...languages import language_of
from ...script.textgrid import INTERVALS, POINTS, Label, Tier, textgrid_lines
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import write_lines

# ARPAbet writes primary stress 1 and secondary 2; Phone.stress counts upwards with strength.
_STRESS_DIGIT = {0: "0", 1: "2", 2: "1"}


def write_textgrid(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write tiers `words`, `phones`, `accents` and `boundaries`, and `marks` if the script names places.

    Raises OutputError if nothing is said.
    """
    if take.utterance is None:
        raise OutputError("there is no speech to write; expected a performance that speaks")
    write_lines(path, utterance_lines(take.utterance))


def utterance_lines(utterance: Utterance) -> Iterator[str]:
    """Yield the lines of an utterance's TextGrid."""
    accents = tuple(Label(accent.time, accent.time, accent.label) for accent in utterance.accents)
    ends = tuple(Label(boundary.time, boundary.time, boundary.label) for boundary in utterance.boundaries)
    points = [Tier("accents", POINTS, accents), Tier("boundaries", POINTS, ends)]
    if utterance.marks:
        points.append(Tier("marks", POINTS, tuple(_marks(utterance.marks))))
    return textgrid_lines(utterance.duration, [*speech_tiers(utterance), *points])


def _marks(marks: Sequence[NamedTime]) -> Iterator[Label]:
    """Yield the marks in order; a tier has one point at a time, so marks of one moment share it."""
    for time, group in groupby(sorted(marks, key=lambda mark: mark.time), key=lambda mark: mark.time):
        yield Label(time, time, ", ".join(mark.name for mark in group))


def speech_tiers(utterance: Utterance) -> tuple[Tier, Tier]:
    """Return the tiers `words` and `phones`."""
    words = tuple(Label(word.start, word.end, word.text) for word in utterance.words)
    phones = tuple(
        Label(phone.start, phone.end, phone_label(phone, utterance.language)) for phone in utterance.phones
    )
    return Tier("words", INTERVALS, words), Tier("phones", INTERVALS, phones)


def phone_label(phone: Phone, language: str) -> str:
    """Return a phone as aligners write it: ARPAbet with stress digits on English vowels; IPA with tones."""
    digits = language_of(language).arpabet and phone.stress >= 0
    return phone.symbol + (_STRESS_DIGIT[phone.stress] if digits else phone.tone)


register(".TextGrid", "words, phones and accents for Praat", {"speech"}, write_textgrid, order=8)
