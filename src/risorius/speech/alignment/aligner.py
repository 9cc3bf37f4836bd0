"""From a recording and its transcript to an Utterance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ...core.audio import Audio
from ...core.utterance import SILENCE, Phone, Utterance, Word
from ...errors import InputError
from ...languages import language_of, phonesets
from ..recordings.resampled import Resampled
from ..structure.accents import intone
from ..structure.pauses import find_pauses
from ..structure.syllables import syllabify
from .decoder import MODEL_LANGUAGE, AlignmentError, Decoders, Found, Readings
from .doubt import check_words
from .edges import place_edges
from .lexicon import ScriptWord, read_transcript, stresses_of
from .silences import without_gaps
from .spectra import band_levels
from .windows import windows

# A stop after silence is heard, and labelled by hand, from its burst on; the articulators close before.
UNHEARD_CLOSURE = 0.015
# Seconds that an edge keeps from the ends of what is around it.
_LEAST = 0.005


def align(audio: Audio, transcript: str) -> Utterance:
    """Return what is said when in a recording of a `transcript`, in the language of the model (English).

    Raises InputError for a transcript without words, and for one that does not fit the recording; warns
    (SpeechWarning) of single words that may not fit.
    """
    resampled = Resampled(audio)
    _, words = read_transcript(transcript)
    heard: list[Found] = []
    found: list[Found] = []
    for stretch in decoded(resampled, [word.readings for word in words]):
        heard += stretch
        found += refined(resampled, stretch)
    check_words(words, heard)
    return assembled(audio, transcript, found, words)


def assembled(audio: Audio, text: str, found: Sequence[Found], words: Sequence[ScriptWord]) -> Utterance:
    """Return the utterance of all that was found, contiguous over the sound; every word has a phone."""
    phones, timed = _timed(found, words, audio.duration)
    language = language_of(MODEL_LANGUAGE)
    syllables = syllabify(phones, timed, language)
    pauses = find_pauses(text, phones, timed, language)
    return intone(Utterance(text, MODEL_LANGUAGE, audio, phones, timed, syllables, pauses))


def decoded(resampled: Resampled, words: Sequence[Readings]) -> Iterator[list[Found]]:
    """Yield the decoder's phones and silences, stretch by stretch, contiguous over the recording.

    Raises InputError if the recording has no room for the words.
    """
    decoders = Decoders()
    for window in windows(resampled, words, decoders):
        inside = words[window.first : window.last]
        if not inside:
            yield [Found(SILENCE, window.start, window.end, -1, 0.0)]
            continue
        try:
            found = decoders.align_words(resampled.read(window.start, window.end), inside)
        except AlignmentError:
            span = f"{window.start:.2f} to {window.end:.2f} s"
            message = (
                f"the transcript does not fit the recording; {len(inside)} words cannot be said from {span}"
            )
            raise InputError(message) from None
        yield without_gaps(moved(found, window.start, window.end, window.first))


def moved(found: Sequence[Found], start: float, end: float, first: int) -> list[Found]:
    """Return what was found in [start, end) with its place in the whole; its first word has index `first`."""
    placed = [
        f._replace(start=f.start + start, end=f.end + start, word=f.word + first if f.word >= 0 else f.word)
        for f in found
    ]
    return respaced(placed, [start, *(f.start for f in placed[1:]), end])


def refined(resampled: Resampled, found: Sequence[Found]) -> list[Found]:
    """Return one stretch with its inner edges placed by the sound."""
    start, end = found[0].start, found[-1].end
    levels = band_levels(resampled.read(start, end))
    edges = np.array([phone.start - start for phone in found[1:]])
    symbols = [phone.symbol for phone in found]
    placed = start + place_edges(levels, symbols, edges)
    for index, (before, stop) in enumerate(pairwise(found)):
        if before.symbol == SILENCE and phonesets.is_stop(stop.symbol):
            placed[index] -= UNHEARD_CLOSURE
    return respaced(found, [start, *placed.tolist(), end])


def respaced(found: Sequence[Found], edges: list[float]) -> list[Found]:
    """Return the phones between `edges`, each of some length."""
    room = (edges[-1] - edges[0]) / (2 * len(found))
    least = min(_LEAST, room)
    for index in range(1, len(found)):
        edges[index] = max(edges[index], edges[index - 1] + least)
    for index in range(len(found) - 1, 0, -1):
        edges[index] = min(edges[index], edges[index + 1] - least)
    return [f._replace(start=a, end=b) for f, (a, b) in zip(found, pairwise(edges), strict=True)]


def _timed(
    found: Sequence[Found], words: Sequence[ScriptWord], duration: float
) -> tuple[tuple[Phone, ...], tuple[Word, ...]]:
    """Return phones with their stress, and the words with their times."""
    spans: list[list[int]] = [[] for _ in words]
    for index, phone in enumerate(found):
        if phone.word >= 0:
            spans[phone.word].append(index)
    stresses = [-1] * len(found)
    for span, word in zip(spans, words, strict=True):
        reading = tuple(found[index].symbol for index in span)
        for index, stress in zip(span, stresses_of(reading, word.stresses), strict=True):
            stresses[index] = stress
    edges = [0.0, *(f.start for f in found[1:]), duration]
    phones = tuple(
        Phone(f.symbol, a, b, stress, f.word)
        for f, (a, b), stress in zip(found, pairwise(edges), stresses, strict=True)
    )
    timed = tuple(
        replace(
            entry.word,
            start=phones[span[0]].start,
            end=phones[span[-1]].end,
            first_phone=span[0],
            last_phone=span[-1] + 1,
        )
        for entry, span in zip(words, spans, strict=True)
    )
    return phones, timed
