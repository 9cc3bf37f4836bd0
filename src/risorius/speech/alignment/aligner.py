"""From a recording and its transcript to an Utterance."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from itertools import islice, pairwise
from typing import NamedTuple

import numpy as np

from ...core.progress import Progress, quiet
from ...core.speech.audio import Audio
from ...core.speech.utterance import SILENCE, Phone, Utterance, Word
from ...errors import InputError
from ...languages import phonesets
from ..resampled import Resampled
from ..structure.build import build_utterance
from .confidence import check_words, mean_score
from .decoder import MODEL_LANGUAGE, AlignedPhone, AlignmentError, Decoders, Readings, with_decoders
from .edges import place_edges
from .glottal import glottal_starts
from .hiss_ends import hiss_ends
from .lexicon import ScriptWord, read_transcript, stresses_of
from .silences import without_gaps
from .spectra import band_levels
from .speech_activity import Condensed, condensed
from .unheard_pauses import with_pauses
from .voice_ends import shared_sounds, voice_ends
from .windows import WHOLE, Window, windows

# A stop after silence is heard, and labelled by hand, from its burst on; the articulators close before.
UNHEARD_CLOSURE = 0.015
# Seconds that an edge keeps from the ends of what is around it.
_LEAST = 0.005


def align(
    audio: Audio, transcript: str, language: str | None = None, progress: Progress = quiet
) -> Utterance:
    """Return the timed utterance of a recording of `transcript`, in `language`, by default English.

    The model is English: the phones of another language are found by the nearest of its phones. Raises
    InputError for a transcript without words, and for one that does not fit the recording, SpeechError for an
    unknown language, and if the aligner fails; warns (SpeechWarning) of single words that may not fit.
    `progress` is told how many seconds of a long recording are aligned.
    """
    found = located(audio, transcript, language, progress)
    return assembled(audio, transcript, found.phones, found.words, found.language)


class Located(NamedTuple):
    """An alignment: phones and silences, contiguous; the words that they belong to, and their language."""

    phones: Sequence[AlignedPhone]
    words: Sequence[ScriptWord]
    language: str


def located(
    audio: Audio, transcript: str, language: str | None = None, progress: Progress = quiet
) -> Located:
    """Return where in a recording the phones of its transcript are; raises and warns as `align` does."""
    spoken, words = read_transcript(transcript, language)
    sound = condensed(Resampled(audio))
    found = decoded(sound, [word.readings for word in words], progress)
    check_words(words, found.rough, sound.time)
    return Located(owned(found.phones, words), words, spoken.language)


def owned(aligned: Sequence[AlignedPhone], words: Sequence[ScriptWord]) -> list[AlignedPhone]:
    """Return aligned phones as those of the words' own language, if that is not the model's."""
    phones = iter(aligned)
    found: list[AlignedPhone] = []
    for phone in phones:
        own = words[phone.word].own if phone.word >= 0 else ()
        if not own:
            found.append(phone)
            continue
        inside = iter((phone, *islice(phones, sum(part.parts for part in own) - 1)))
        for symbol, count in own:
            parts = list(islice(inside, count))
            found.append(parts[0]._replace(symbol=symbol, end=parts[-1].end, score=mean_score(parts)))
    return found


def assembled(
    audio: Audio,
    text: str,
    aligned: Sequence[AlignedPhone],
    words: Sequence[ScriptWord],
    code: str = MODEL_LANGUAGE,
) -> Utterance:
    """Return the utterance of all aligned phones, contiguous over the sound; every word has a phone.

    `code` is the language of the words.
    """
    phones, timed = _timed(aligned, words, audio.duration)
    return build_utterance(text, code, audio, phones, timed)


class Decoded(NamedTuple):
    """Phones and silences: `rough` as the decoder finds them in the condensed sound, with their scores; and
    `phones` with edges placed by the sound, at their times in the recording. Both are contiguous.
    """

    rough: Sequence[AlignedPhone]
    phones: Sequence[AlignedPhone]


def decoded(sound: Condensed, words: Sequence[Readings], progress: Progress = quiet) -> Decoded:
    """Return where a recording's words are.

    Raises InputError if the recording has no room for the words, SpeechError if the aligner fails.
    """
    resampled = Resampled(sound.audio)

    def work(decoders: Decoders) -> list[tuple[list[AlignedPhone], list[AlignedPhone]]]:
        # A stretch is refined while the next is decoded.
        found = _stretches(resampled, words, decoders, progress)
        return [(stretch, refined(resampled, stretch)) for stretch in found]

    try:
        stretches = with_decoders(work)
    except _NoRoomError as error:
        span = f"{sound.time(error.start):.2f} to {sound.time(error.end):.2f} s"
        message = f"the transcript does not fit the recording; {error.count} words do not fit into {span}"
        raise InputError(message) from None
    rough = [phone for stretch, _ in stretches for phone in stretch]
    return Decoded(rough, sound.placed([phone for _, stretch in stretches for phone in stretch]))


class _NoRoomError(Exception):
    """The `count` words of a window do not fit into [start, end) seconds."""

    def __init__(self, window: Window) -> None:
        self.start, self.end, self.count = window.start, window.end, window.last - window.first


def _stretches(
    resampled: Resampled, words: Sequence[Readings], decoders: Decoders, progress: Progress
) -> Iterator[list[AlignedPhone]]:
    whole = resampled.audio.duration
    begun: deque[tuple[Window, Future[list[AlignedPhone]] | None]] = deque()
    for window in _ahead(windows(resampled, words, decoders)):
        inside, last = words[window.first : window.last], window.end >= whole
        sound = resampled.read(window.start, window.end)
        begun.append((window, decoders.align_in_turn(sound, inside, last=last) if inside else None))
        if whole > WHOLE:
            progress("Aligning …", round(begun[0][0].start), round(whole))
        if len(begun) > 1:
            yield _stretch(*begun.popleft())
    while begun:
        yield _stretch(*begun.popleft())


def _stretch(window: Window, alignment: Future[list[AlignedPhone]] | None) -> list[AlignedPhone]:
    """Return the phones and silences of a window, in which nothing is said unless it is being aligned."""
    if alignment is None:
        return [AlignedPhone(SILENCE, window.start, window.end, -1, 0.0)]
    try:
        aligned = alignment.result()
    except AlignmentError:
        raise _NoRoomError(window) from None
    return without_gaps(moved(aligned, window.start, window.end, window.first))


def _ahead(found: Iterator[Window]) -> Iterator[Window]:
    """Yield windows; while one is worked on, the next is found in another thread."""
    with ThreadPoolExecutor(1, "follow") as thread:
        coming = thread.submit(next, found, None)
        while (window := coming.result()) is not None:
            coming = thread.submit(next, found, None)
            yield window


def moved(aligned: Sequence[AlignedPhone], start: float, end: float, first: int) -> list[AlignedPhone]:
    """Return phones aligned in [start, end) at their place in the whole; the first word has index `first`."""
    placed = [
        f._replace(start=f.start + start, end=f.end + start, word=f.word + first if f.word >= 0 else f.word)
        for f in aligned
    ]
    return respaced(placed, [start, *(f.start for f in placed[1:]), end])


def refined(resampled: Resampled, aligned: Sequence[AlignedPhone]) -> list[AlignedPhone]:
    """Return one stretch with its inner edges placed by the sound, and with pauses that were not heard."""
    start, end = aligned[0].start, aligned[-1].end
    levels = band_levels(resampled.read(start, end))
    aligned = with_pauses(levels, aligned, start)
    edges = np.array([phone.start - start for phone in aligned[1:]])
    symbols = [phone.symbol for phone in aligned]
    placed = voice_ends(levels, aligned, place_edges(levels, symbols, edges))
    placed = hiss_ends(levels, aligned, shared_sounds(aligned, placed))
    placed = start + glottal_starts(levels, aligned, placed)
    for index, (before, stop) in enumerate(pairwise(aligned)):
        if before.symbol == SILENCE and phonesets.is_stop(stop.symbol):
            placed[index] -= UNHEARD_CLOSURE
    return respaced(aligned, [start, *placed.tolist(), end])


def respaced(aligned: Sequence[AlignedPhone], edges: list[float]) -> list[AlignedPhone]:
    """Return the phones between `edges`, each of some length."""
    room = (edges[-1] - edges[0]) / (2 * len(aligned))
    least = min(_LEAST, room)
    for index in range(1, len(aligned)):
        edges[index] = max(edges[index], edges[index - 1] + least)
    for index in range(len(aligned) - 1, 0, -1):
        edges[index] = min(edges[index], edges[index + 1] - least)
    return [f._replace(start=a, end=b) for f, (a, b) in zip(aligned, pairwise(edges), strict=True)]


def _timed(
    aligned: Sequence[AlignedPhone], words: Sequence[ScriptWord], duration: float
) -> tuple[tuple[Phone, ...], tuple[Word, ...]]:
    """Return phones with their stress, and the words with their times."""
    spans: list[list[int]] = [[] for _ in words]
    for index, phone in enumerate(aligned):
        if phone.word >= 0:
            spans[phone.word].append(index)
    stresses = [-1] * len(aligned)
    for span, word in zip(spans, words, strict=True):
        reading = tuple(aligned[index].symbol for index in span)
        for index, stress in zip(span, stresses_of(reading, word.stresses), strict=True):
            stresses[index] = stress
    edges = [0.0, *(f.start for f in aligned[1:]), duration]
    phones = tuple(
        Phone(f.symbol, a, b, stress, f.word)
        for f, (a, b), stress in zip(aligned, pairwise(edges), stresses, strict=True)
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
