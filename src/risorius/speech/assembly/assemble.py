"""Putting spoken lines together: the sound of all, and their segments, from which phones and words are made
once.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Sequence, Set
from contextlib import ExitStack
from itertools import chain
from typing import NamedTuple

import numpy as np

from ...core.directions import Directions
from ...core.speech.audio import Audio, AudioWriter, Samples
from ...core.speech.utterance import SILENCE, Phone, Word
from ...errors import InputError, SpeechWarning, warn
from ...languages.abbreviations import Replacement
from ..engines.protocol import Rendition
from ..structure.lines import TextLine
from ..structure.pauses import punctuation_kind
from ..text.normalise import NormalisedText
from ..text.sentences import TextStretch
from ..text.tokens import Token
from .retime import is_timed, retime
from .sync_times import at_sync_times, has_times
from .timing import NO_TOKEN, Segment, settle
from .words import Transcriber, assign

LINE_PAUSE = 0.3
"""Seconds between two lines if the second has no time of its own."""


# Words that a warning names.
_NAMED = 5


class SpokenPart(NamedTuple):
    """A stretch of the text, its text for the engine, and the engine's rendition of it."""

    stretch: TextStretch
    spoken: NormalisedText
    rendition: Rendition


class PreparedLine(NamedTuple):
    """A line that is to be spoken: `offset` is its first character in the whole text.

    `tokens` and `directions` count the characters of the line. `dictated`: what is said in place of what is
    written; `shape`: the text with letters there, in which sentences are found. `time`: where its sound
    starts; if it is None, `gap` after the line before. `lead` and `tail`: the silence around it. All in
    seconds.
    """

    text: str
    tokens: Sequence[Token]
    directions: Directions
    offset: int = 0
    time: float | None = None
    gap: float = LINE_PAUSE
    lead: float = 0.0
    tail: float = 0.0
    shape: str = ""
    dictated: Sequence[Replacement] = ()


class SpokenText(NamedTuple):
    """All of a text with its sound: phones and words, in seconds, and the lines that they belong to."""

    text: str
    audio: Audio
    phones: tuple[Phone, ...]
    words: tuple[Word, ...]
    lines: tuple[TextLine, ...]


class Assembler:
    """Puts lines, spoken in their order, into one sound."""

    def __init__(self) -> None:
        self._files = ExitStack()
        self._writer: AudioWriter | None = None
        self._segments: list[Segment] = []
        self._tokens: list[Token] = []
        self._lines: list[TextLine] = []

    def __enter__(self) -> Assembler:
        return self

    def __exit__(self, *error: object) -> None:
        self._files.close()

    def add(self, line: PreparedLine, parts: Iterable[SpokenPart], transcribe: Transcriber) -> None:
        """Append a line.

        Raises InputError if it starts before the line before it has ended, and if no word of it has a sound.
        """
        parts = iter(parts)
        first = next(parts)
        if self._writer is None:
            self._writer = self._files.enter_context(AudioWriter(first.rendition.sample_rate))
        self._wait(line, self._writer)
        segments = _spoken(line, chain([first], parts), transcribe, self._writer)
        for segment in segments:
            if segment.token != NO_TOKEN:
                segment.token += len(self._tokens)
        phones = range(len(self._segments), len(self._segments) + len(segments))
        characters = range(line.offset, line.offset + len(line.text))
        self._lines.append(TextLine(phones, characters, line.directions.moved(line.offset)))
        self._segments += segments
        self._tokens += [Token(t.text, t.start + line.offset, t.end + line.offset) for t in line.tokens]

    def finish(self, text: str) -> SpokenText:
        """Close the sound and return the spoken `text`; raise ValueError if no line was added."""
        if self._writer is None:
            raise ValueError("nothing was spoken")
        audio = self._writer.finish()
        phones, words = assemble(self._segments, self._tokens, audio.sample_rate)
        return SpokenText(text, audio, phones, words, tuple(self._lines))

    def _wait(self, line: PreparedLine, writer: AudioWriter) -> None:
        """Append the silence before a line."""
        rate, end = writer.sample_rate, writer.frames
        follows = end + round(line.gap * rate) if end else 0
        start = follows if line.time is None else round(line.time * rate)
        if start < end:
            raise InputError(
                f"time = {line.time:g} s overlaps the previous line, which ends at {end / rate:.2f} s"
            )
        if start > end:
            self._segments.append(Segment(SILENCE, end, start))
            writer.silence((start - end) / rate)


def _spoken(
    line: PreparedLine, parts: Iterable[SpokenPart], transcribe: Transcriber, writer: AudioWriter
) -> list[Segment]:
    """Append the sound of a line to `writer`, and return its segments with indices into its own tokens."""
    rate, start = writer.sample_rate, writer.frames
    timed = is_timed(line.directions) or has_times(line.directions)
    sound: list[Samples] = []
    write = sound.append if timed else writer.append
    segments, at = _silence(start, line.lead, rate)
    write(np.zeros(at - start, np.int16))
    given: list[NormalisedText] = []
    for part in parts:
        segments += place(part, line.tokens, at, transcribe)
        given.append(part.spoken)
        write(part.rendition.samples)
        at += len(part.rendition.samples)
    tail, end = _silence(at, line.tail, rate)
    write(np.zeros(end - at, np.int16))
    segments += tail
    _keep_punctuated(segments, line.text, line.tokens)
    segments = settle(segments, rate)
    if all(segment.token == NO_TOKEN for segment in segments):
        raise InputError("nothing in the text can be spoken by this voice; expected words of its language")
    _tell_of_unread(line.tokens, {segment.token for segment in segments}, given, transcribe)
    if timed:
        samples, segments = _at_times(np.concatenate(sound), segments, line, rate)
        writer.append(samples)
    return segments


def _at_times(
    samples: Samples, segments: list[Segment], line: PreparedLine, rate: int
) -> tuple[Samples, list[Segment]]:
    """Return a line's sound and segments with the times that its script gives."""
    if is_timed(line.directions):
        samples, segments = retime(samples, segments, line.tokens, line.directions, rate)
    if has_times(line.directions):
        samples, segments = at_sync_times(samples, segments, line.tokens, line.directions, rate)
    return samples, segments


def _tell_of_unread(
    tokens: Sequence[Token], voiced: Set[int], given: Sequence[NormalisedText], transcribe: Transcriber
) -> None:
    """Warn of words that the engine was given, and gave no sound."""
    silent = [token for index, token in enumerate(tokens) if index not in voiced]
    if not silent:
        return
    letters = sorted({at for part in given for char, at in zip(*part, strict=True) if char.isalnum()})
    silent = [token for token in silent if _within(letters, token)]
    # Words that the engine says as one belong to the first of them: they have sounds by themselves.
    alone = transcribe([token.text for token in silent]) if silent else ()
    unread = [token.text for token, phones in zip(silent, alone, strict=True) if not phones]
    if unread:
        more = f" and {len(unread) - _NAMED} more" if len(unread) > _NAMED else ""
        names = ", ".join(f"'{word}'" for word in unread[:_NAMED])
        warn(f"this voice cannot read {names}{more}; expected words of its language", SpeechWarning)


def _within(places: Sequence[int], token: Token) -> bool:
    return bisect_left(places, token.start) < bisect_left(places, token.end)


def _silence(start: int, seconds: float, sample_rate: int) -> tuple[list[Segment], int]:
    """Return the segment of a silence, none if it has no length, and where it ends."""
    end = start + round(seconds * sample_rate)
    return [Segment(SILENCE, start, end, intended=True)] if end > start else [], end


def place(part: SpokenPart, tokens: Sequence[Token], offset: int, transcribe: Transcriber) -> list[Segment]:
    """Return the segments of a part that starts at sample `offset`, each with its index into `tokens`."""
    rendition = part.rendition
    starts = [phone.start for phone in rendition.phones] + [len(rendition.samples)]
    segments = [Segment(SILENCE, offset, offset + starts[0])] if starts[0] > 0 else []
    owners = iter(_owners(part, tokens, transcribe))
    for phone, end in zip(rendition.phones, starts[1:], strict=True):
        token = NO_TOKEN if phone.symbol == SILENCE else next(owners)
        times = (offset + phone.start, offset + end)
        segments.append(Segment(phone.symbol, *times, phone.stress, phone.closure, token, tone=phone.tone))
    return segments


def _owners(part: SpokenPart, tokens: Sequence[Token], transcribe: Transcriber) -> list[int]:
    """Return the token of every phone that is not silent."""
    sounding = [phone for phone in part.rendition.phones if phone.symbol != SILENCE]
    if not sounding:
        return []
    first = bisect_right(tokens, part.stretch.start, key=lambda token: token.end)
    last = bisect_left(tokens, part.stretch.end, key=lambda token: token.start)
    symbols = [phone.symbol for phone in sounding]
    positions = [phone.position for phone in sounding]
    return [first + i for i in assign(symbols, positions, part.spoken, tokens[first:last], transcribe)]


def assemble(
    segments: Sequence[Segment], tokens: Sequence[Token], sample_rate: int
) -> tuple[tuple[Phone, ...], tuple[Word, ...]]:
    """Return phones and words in seconds. A token without phones ("*") is not a word."""
    spans: dict[int, list[int]] = {}
    for index, segment in enumerate(segments):
        if segment.token != NO_TOKEN:
            spans.setdefault(segment.token, []).append(index)
    numbers = {token: number for number, token in enumerate(spans)}
    phones = tuple(_phone(s, sample_rate, numbers.get(s.token, NO_TOKEN)) for s in segments)
    return phones, tuple(_word(tokens[token], inside, phones) for token, inside in spans.items())


def _phone(segment: Segment, sample_rate: int, word: int) -> Phone:
    start, end = segment.start / sample_rate, segment.end / sample_rate
    return Phone(segment.symbol, start, end, segment.stress, word, segment.tone)


def _word(token: Token, inside: list[int], phones: Sequence[Phone]) -> Word:
    first, last = inside[0], inside[-1]
    return Word(token.text, phones[first].start, phones[last].end, first, last + 1, token.start, token.end)


def _keep_punctuated(segments: list[Segment], text: str, tokens: Sequence[Token]) -> None:
    """Mark the silences between two words that punctuation asks for."""
    before = NO_TOKEN
    waiting: list[Segment] = []
    for segment in segments:
        if segment.silent:
            waiting.append(segment)
            continue
        if waiting and before not in (NO_TOKEN, segment.token):
            punctuated = punctuation_kind(text[tokens[before].end : tokens[segment.token].start]) is not None
            for silence in waiting:
                silence.intended |= punctuated
        waiting = []
        before = segment.token
