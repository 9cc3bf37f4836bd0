"""Putting spoken stretches together: segments of one utterance, then its phones and words."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from typing import NamedTuple

from ...core.audio import AudioWriter
from ...core.utterance import SILENCE, Phone, Word
from ..engines.protocol import Rendition
from ..structure.pauses import punctuation_kind
from ..text.normalise import NormalisedText
from ..text.sentences import TextStretch
from ..text.tokens import Token
from .timing import NO_TOKEN, Segment, settle
from .words import Transcriber, assign


class SpokenPart(NamedTuple):
    """A stretch of the text, its text for the engine, and the engine's rendition of it."""

    stretch: TextStretch
    spoken: NormalisedText
    rendition: Rendition


def silence(writer: AudioWriter, seconds: float) -> list[Segment]:
    """Write silence, and return its segment unless it has no length."""
    start = writer.frames
    writer.silence(seconds)
    return [Segment(SILENCE, start, writer.frames, intended=True)] if writer.frames > start else []


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
    segments: list[Segment], text: str, tokens: Sequence[Token], sample_rate: int
) -> tuple[tuple[Phone, ...], tuple[Word, ...]]:
    """Mend the times of all segments and return phones and words in seconds.

    A token without phones ("*") is not a word.
    """
    _keep_punctuated(segments, text, tokens)
    settled = settle(segments, sample_rate)
    spans: dict[int, list[int]] = {}
    for index, segment in enumerate(settled):
        if segment.token != NO_TOKEN:
            spans.setdefault(segment.token, []).append(index)
    numbers = {token: number for number, token in enumerate(spans)}
    phones = tuple(_phone(s, sample_rate, numbers.get(s.token, NO_TOKEN)) for s in settled)
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
