"""Speech brought to the times that its script gives for every phone and pause (paper B, section 5.1)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ...core.audio import Audio, AudioWriter, Samples
from ...core.directions import DirectedSpan, Directions
from ...core.utterance import SILENCE, Phone, Word
from ...languages import phonesets
from ..engines.mnemonics import to_arpabet
from .stretch import stretch

_STRESS = {"0": 0, "1": 2, "2": 1}


class Retimed(NamedTuple):
    """The sound, phones and words at their new times."""

    audio: Audio
    phones: tuple[Phone, ...]
    words: tuple[Word, ...]


@dataclass(frozen=True, slots=True)
class _Piece:
    """A silence or a word: its phones with their new lengths, and the edges of those it had; in samples."""

    edges: tuple[int, ...]
    word: int
    phones: tuple[tuple[Phone, int], ...]

    @property
    def length(self) -> int:
        return sum(length for _, length in self.phones)


def is_timed(directions: Directions) -> bool:
    """Tell whether any phone has a duration of its own."""
    return any(span.seconds for span in directions.spans)


def retime(audio: Audio, phones: Sequence[Phone], words: Sequence[Word], directions: Directions) -> Retimed:
    """Return the speech with the durations of `directions`; words without any keep theirs.

    Between two words that have them, only the breaks given are silent.
    """
    rate = audio.sample_rate
    samples = np.concatenate(list(audio.blocks()))
    pieces = list(_pieces(phones, words, directions, rate))
    with AudioWriter(rate) as writer:
        for piece in pieces:
            writer.append(_sound(piece, samples, rate))
        new_audio = writer.finish()
    return Retimed(new_audio, *_counted(pieces, words, rate))


def _pieces(
    phones: Sequence[Phone], words: Sequence[Word], directions: Directions, rate: int
) -> Iterator[_Piece]:
    timed = [_span_of(word, directions) for word in words]
    index = 0
    while index < len(phones):
        phone = phones[index]
        stop = words[phone.word].last_phone if phone.symbol else index + 1
        inside = phones[index:stop]
        edges = tuple(round(at * rate) for at in (inside[0].start, *(p.end for p in inside)))
        span = timed[phone.word] if phone.symbol else None
        if span is not None:
            yield _Piece(edges, phone.word, tuple(_dictated(span, phone.word, rate)))
        elif phone.symbol:
            yield _Piece(edges, phone.word, tuple((p, round(p.duration * rate)) for p in inside))
        else:
            yield _Piece(edges, -1, ((phone, _silence(phones, index, words, timed, directions, rate)),))
        index = stop
        before, after = phones[stop - 1].word, phones[stop].word if stop < len(phones) else -1
        if before >= 0 and after >= 0 and timed[before] and timed[after]:
            seconds = _breaks(words[before], words[after], directions)
            if seconds:
                yield _Piece(edges[-1:], -1, ((Phone(SILENCE, 0.0, 1.0), round(seconds * rate)),))


def _span_of(word: Word, directions: Directions) -> DirectedSpan | None:
    return next((s for s in directions.spans if s.seconds and s.start <= word.source_start < s.end), None)


def dictated_phones(span: DirectedSpan) -> Iterator[tuple[str, int, float]]:
    """Yield symbol, stress and seconds of each phone that is written for a word with durations."""
    for written, seconds in zip(span.phones, span.seconds, strict=True):
        (phone,) = to_arpabet(written)
        vowel = phone[:-1] in phonesets.VOWELS
        yield phone[:-1] if vowel else phone, _STRESS[phone[-1]] if vowel else -1, seconds


def _dictated(span: DirectedSpan, word: int, rate: int) -> Iterator[tuple[Phone, int]]:
    for symbol, stress, seconds in dictated_phones(span):
        yield Phone(symbol, 0.0, 1.0, stress, word), round(seconds * rate)


def _silence(
    phones: Sequence[Phone],
    index: int,
    words: Sequence[Word],
    timed: Sequence[DirectedSpan | None],
    directions: Directions,
    rate: int,
) -> int:
    """Return how many samples a silence lasts: its own length, or that of the breaks between timed words."""
    before = phones[index - 1].word if index else -1
    after = phones[index + 1].word if index + 1 < len(phones) else -1
    if before < 0 or after < 0 or not (timed[before] and timed[after]):
        return round(phones[index].end * rate) - round(phones[index].start * rate)
    return round(_breaks(words[before], words[after], directions) * rate)


def _breaks(before: Word, after: Word, directions: Directions) -> float:
    return sum(b.seconds for b in directions.breaks if before.source_end <= b.at <= after.source_start)


def _sound(piece: _Piece, samples: Samples, rate: int) -> Samples:
    if piece.word < 0:
        return np.zeros(piece.length, np.int16)
    source = np.array(piece.edges, dtype=np.float64)
    target = np.cumsum([0.0, *(length for _, length in piece.phones)])
    if len(source) != len(target):
        # Phones that the voice made more or fewer of: only the word's ends are sure.
        source, target = source[[0, -1]], target[[0, -1]]
    if np.array_equal(source - source[0], target):
        return samples[piece.edges[0] : piece.edges[-1]]
    return stretch(samples, source, target, rate)


def _counted(
    pieces: Sequence[_Piece], words: Sequence[Word], rate: int
) -> tuple[tuple[Phone, ...], tuple[Word, ...]]:
    """Return phones and words at their new times."""
    retimed: list[Phone] = []
    placed: list[Word] = []
    at = 0
    for piece in pieces:
        first = len(retimed)
        for phone, length in piece.phones:
            if length:
                retimed.append(replace(phone, start=at / rate, end=(at + length) / rate))
                at += length
        if piece.word >= 0:
            word = replace(words[piece.word], start=retimed[first].start, end=retimed[-1].end)
            placed.append(replace(word, first_phone=first, last_phone=len(retimed)))
    return tuple(retimed), tuple(placed)
