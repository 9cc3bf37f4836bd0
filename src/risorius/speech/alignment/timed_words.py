"""Words whose times are known, as speech services send them: only the phones within them are searched."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...core.speech.audio import Audio
from ...core.speech.utterance import SILENCE
from ...errors import InputError
from ...script.quote import quoted
from ..resampled import Resampled
from .aligner import Located, decoded, owned, respaced
from .decoder import AlignedPhone
from .lexicon import ScriptWord, read_transcript
from .speech_activity import condensed

# Seconds by which a word may begin before the one before it ends, and end after the sound: times are rounded.
OVERLAP, BEYOND = 0.05, 0.1
# A shorter gap between two words is not a silence: the first word fills it.
SHORTEST_PAUSE = 0.05
_LEAST = 0.01


class TimedWord(NamedTuple):
    """A word as it is written, with its punctuation, said in [start, end) seconds."""

    text: str
    start: float
    end: float


def check_times(words: Sequence[TimedWord], after: float = 0.0) -> None:
    """Raise InputError unless words follow one another in time, the first one not before `after`."""
    reached = after
    for word in words:
        lasting = f"the word {quoted(word.text)} lasts from {word.start:g} to {word.end:g} s"
        if not (math.isfinite(word.start) and math.isfinite(word.end) and 0.0 <= word.start <= word.end):
            raise InputError(f"{lasting}; expected it to end after it starts")
        if word.start < reached - OVERLAP:
            raise InputError(f"{lasting}, the one before it to {reached:g} s; expected one after another")
        reached = max(reached, word.end)


def written(words: Sequence[TimedWord]) -> str:
    """Return the words as a text."""
    return " ".join(word.text.strip() for word in words)


def locate_in_words(audio: Audio, words: Sequence[TimedWord], language: str | None = None) -> Located:
    """Return where in a recording the phones of words are that are said when they say.

    Where nothing is said is silence. Raises InputError for times that no recording has, or this one has not,
    and for words of which none can be spoken; SpeechError if the aligner fails.
    """
    check_times(words)
    if words and words[-1].end > audio.duration + BEYOND:
        message = f"the word {quoted(words[-1].text)} ends at {words[-1].end:g} s, but the sound at"
        raise InputError(f"{message} {audio.duration:.3f} s; expected times within the sound")
    spoken, script = read_transcript(written(words), language)
    found = _found(audio, script)
    spans = _spans(words, script, audio.duration)
    phones: list[AlignedPhone] = []
    for span in spans:
        reached = phones[-1].end if phones else 0.0
        start = max(span.start, reached)
        if start - reached >= SHORTEST_PAUSE or (not phones and start > 0.0):
            phones.append(AlignedPhone(SILENCE, reached, start, -1, 0.0))
        elif phones:
            phones[-1] = phones[-1]._replace(end=start)
        span_phones = [phone for number in span.words for phone in found[number]]
        phones += _fitted(span_phones, start, max(span.end, start + _LEAST))
    reached = phones[-1].end
    if audio.duration - reached >= SHORTEST_PAUSE:
        phones.append(AlignedPhone(SILENCE, reached, audio.duration, -1, 0.0))
    edges = [0.0, *(phone.start for phone in phones[1:]), audio.duration]
    return Located(respaced(phones, edges), script, spoken.language)


@dataclass(frozen=True, slots=True)
class _Span:
    """The numbers of the script's words that are said in [start, end) seconds."""

    start: float
    end: float
    words: tuple[int, ...]


def _spans(words: Sequence[TimedWord], script: Sequence[ScriptWord], duration: float) -> list[_Span]:
    """Return the spans of words that can be spoken."""
    edges = np.cumsum([len(word.text.strip()) + 1 for word in words])
    owners = np.searchsorted(edges, [entry.word.source_start for entry in script], "right")
    spans = []
    for number, word in enumerate(words):
        inside = tuple(np.flatnonzero(owners == number).tolist())
        if inside:
            spans.append(_Span(min(word.start, duration), min(word.end, duration), inside))
    return spans


def _found(audio: Audio, script: Sequence[ScriptWord]) -> list[list[AlignedPhone]]:
    """Return each word's phones where the aligner finds them; the first reading if it finds nothing."""
    try:
        found = decoded(condensed(Resampled(audio)), [word.readings for word in script])
    except InputError:
        return [_evenly(word, number) for number, word in enumerate(script)]
    phones: list[list[AlignedPhone]] = [[] for _ in script]
    for phone in owned(found.phones, script):
        if phone.word >= 0:
            phones[phone.word].append(phone)
    return phones


def _evenly(word: ScriptWord, number: int) -> list[AlignedPhone]:
    symbols = [part.symbol for part in word.own] or word.readings[0]
    return [AlignedPhone(symbol, float(k), k + 1.0, number, 0.0) for k, symbol in enumerate(symbols)]


def _fitted(phones: Sequence[AlignedPhone], start: float, end: float) -> list[AlignedPhone]:
    """Return phones that fill [start, end), longer if they were found longer.

    What was found elsewhere, by more than half of its length, tells nothing of their lengths.
    """
    lengths = np.array([max(phone.end - phone.start, 1e-3) for phone in phones])
    common = min(end, phones[-1].end) - max(start, phones[0].start)
    if common < 0.5 * min(end - start, phones[-1].end - phones[0].start):
        lengths = np.ones(len(phones))
    edges = start + (end - start) * np.concatenate([[0.0], np.cumsum(lengths) / lengths.sum()])
    return [f._replace(start=a, end=b) for f, (a, b) in zip(phones, pairwise(edges.tolist()), strict=True)]
