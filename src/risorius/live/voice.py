"""The face's own voice as it comes, in pieces: phrases out of it, the same ones however it is cut."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from ..core.speech.audio import Samples
from ..errors import InputError
from ..reading.hints import shown
from ..reading.source_text import Syntax
from ..speech.alignment.timed_words import TimedWord, check_times, written
from ..speech.recordings.recording import HIGHEST_RATE, LOWEST_RATE
from .pcm import PcmDecoder, check_rate, samples_of

LONGEST_WAITING = 120.0
"""Seconds of sound that may wait for the end of their phrase."""
# Seconds. A phrase whose words' times are known ends before a gap, or where punctuation has any; not sooner
# than the last.
GAP, MARKED_GAP, SHORTEST = 0.25, 0.04, 0.6
_MARKS = tuple(".!?,;:…。！？、，；：)\"'”’»")
# Other phrases end in a pause, seconds, so far below the loudest, decibels, not before the third; by ear, if
# none comes, where it is quietest within the last seconds.
PAUSE, BELOW, EARLIEST, LATEST, WITHIN = 0.3, 30.0, 1.0, 6.0, 2.0
_BLOCK, _QUIETEST = 0.02, -50.0


class Known(Enum):
    """Knowledge about the words of a voice."""

    TIMES = "its words and their times"
    TEXT = "its text"
    NOTHING = "nothing"


@dataclass(frozen=True, slots=True)
class VoicedPhrase:
    """A phrase of the voice: its `samples`, and its words with their times or the text received since the
    previous phrase. If `is_open`, the phrase covers only the beginning of that text.
    """

    samples: Samples
    sample_rate: int
    known: Known
    text: str = ""
    words: tuple[TimedWord, ...] = ()
    is_open: bool = False

    @property
    def duration(self) -> float:
        """Seconds."""
        return len(self.samples) / self.sample_rate


class VoiceBuffer:
    """Collects sound until a phrase is whole.

    With the words' times a phrase is whole when the word after a gap, or after punctuation, is known. Without
    them it ends in a pause; without a text, too, after 6 s at the latest.
    """

    def __init__(self) -> None:
        self._decoder: PcmDecoder | None = None
        self._rate = 0
        self._sound: Samples = np.zeros(0, np.int16)
        self._text = ""
        self._has_text = False
        self._words: list[TimedWord] = []
        # Seconds from where words are counted to the sound that waits; blocks that a pause was sought in.
        self._since = 0.0
        self._pauses = _PauseFinder()

    def __bool__(self) -> bool:
        return bool(len(self._sound) or self._words)

    @property
    def text(self) -> str:
        """The text of the sound that waits, as far as it is known."""
        return written(self._words) or self._text

    def add(
        self,
        audio: ArrayLike | bytes,
        rate: int,
        encoding: str = "pcm_s16le",
        text: str = "",
        words: Iterable[tuple[str, float, float]] = (),
    ) -> list[VoicedPhrase]:
        """Add a piece of sound; return the phrases that are whole now.

        `audio`: bytes of this encoding, cut anywhere, or samples. `words`: with their seconds since the sound
        began, or since `flush`; they come with their sound or after it. Raises InputError for what cannot be
        used, which is not added then.
        """
        check_rate(rate, LOWEST_RATE, HIGHEST_RATE)
        if self and rate != self._rate:
            raise InputError(f"{rate:,} Hz after {self._rate:,} Hz; expected one sample rate until flush")
        if not isinstance(words, Iterable):
            raise InputError(f"words are {type(words).__name__}; expected a list of (word, start, end)")
        timed = [_timed_word(word) for word in words]
        check_times(timed, self._words[-1].end if self._words else self._since)
        written_text = self._text + text
        if written_text:
            timed, written_text = _as_written(timed, written_text)
        decoder = self._decoder
        if decoder is None or decoder.encoding != encoding:
            decoder = PcmDecoder(encoding)
        added = decoder.decode(audio) if isinstance(audio, bytes) else samples_of(audio)
        if len(self._sound) + len(added) > LONGEST_WAITING * rate:
            message = f"more than {LONGEST_WAITING:g} s of sound"
            raise InputError(f"{message}; expected flush after each sentence")
        self._decoder, self._rate = decoder, rate
        self._sound = np.concatenate([self._sound, added])
        self._text, self._has_text = written_text, self._has_text or bool(text)
        self._words += timed
        return list(self._whole())

    def flush(self) -> list[VoicedPhrase]:
        """Return the waiting sound as a phrase, and start to count words anew."""
        phrases = [self._phrase(len(self._sound), len(self._words))] if len(self._sound) else []
        self._decoder, self._text, self._has_text, self._words, self._since = None, "", False, [], 0.0
        self._sound, self._pauses = np.zeros(0, np.int16), _PauseFinder()
        return phrases

    def _whole(self) -> Iterator[VoicedPhrase]:
        if self._words:
            while (cut := self._gap()) is not None:
                yield self._cut(*cut)
        else:
            latest = LONGEST_WAITING if self._has_text else LATEST
            while (samples := self._pauses.find(self._sound, self._rate, latest)) is not None:
                yield self._cut(samples, 0)

    def _gap(self) -> tuple[int, int] | None:
        """Return the samples and words before the first gap that ends a phrase, if it is there."""
        for number in range(1, len(self._words)):
            before, after = self._words[number - 1 : number + 1]
            gap = after.start - before.end
            needed = MARKED_GAP if before.text.rstrip().endswith(_MARKS) else GAP
            middle = round((0.5 * (before.end + after.start) - self._since) * self._rate)
            if after.start - self._since >= SHORTEST and gap >= needed:
                come = round((after.start - self._since) * self._rate) <= len(self._sound)
                return (middle, number) if come else None
        return None

    def _cut(self, samples: int, words: int) -> VoicedPhrase:
        phrase = replace(self._phrase(samples, words), is_open=True)
        self._sound, self._words = self._sound[samples:], self._words[words:]
        self._text = self._text if words else ""
        self._since += samples / self._rate
        self._pauses = _PauseFinder()
        return phrase

    def _phrase(self, samples: int, words: int) -> VoicedPhrase:
        timed = tuple(
            TimedWord(word.text, max(word.start - self._since, 0.0), word.end - self._since)
            for word in self._words[:words]
        )
        text = Known.TEXT if self._has_text else Known.NOTHING
        timing = Known.TIMES if self._words else text
        return VoicedPhrase(self._sound[:samples], self._rate, timing, self._text, timed)


class _PauseFinder:
    """Finds where a phrase ends by ear, in sound that grows."""

    def __init__(self) -> None:
        self._levels: list[float] = []
        self._loudest = _QUIETEST
        self._quiet = 0

    def find(self, sound: Samples, rate: int, latest: float) -> int | None:
        """Return the samples before the end of the first phrase, None while no phrase has ended."""
        size = round(rate * _BLOCK)
        for start in range(len(self._levels) * size, len(sound) - size + 1, size):
            block = sound[start : start + size] / 32_768.0
            level = 10.0 * float(np.log10(np.mean(block**2) + 1e-12))
            self._levels.append(level)
            self._loudest = max(self._loudest, level)
            is_quiet = level <= max(self._loudest - BELOW, _QUIETEST)
            self._quiet = self._quiet + 1 if is_quiet else 0
            seconds = len(self._levels) * _BLOCK
            if self._quiet * _BLOCK >= PAUSE and seconds >= EARLIEST:
                return (len(self._levels) - self._quiet // 2) * size
            if seconds >= latest:
                last = np.array(self._levels[-round(WITHIN / _BLOCK) :])
                return (len(self._levels) - len(last) + int(last.argmin())) * size
        return None


def _as_written(words: Iterable[TimedWord], text: str) -> tuple[list[TimedWord], str]:
    """Return the words as they stand in a text, with the marks behind them; and the text after the last."""
    written, low = [], text.casefold()
    place = 0
    for word in words:
        start = low.find(word.text.strip().casefold(), place)
        if start >= 0:
            place = end = start + len(word.text.strip())
            while end < len(text) and not text[end].isspace() and not text[end].isalnum():
                end += 1
            word, place = word._replace(text=text[start:end]), end
        written.append(word)
    return written, text[place:]


def _timed_word(word: Sequence[object]) -> TimedWord:
    """Return a word and its times; raise InputError for anything else."""
    try:
        text, start, end = word
        times = start, end
        if isinstance(text, str) and all(isinstance(t, Real) and not isinstance(t, bool) for t in times):
            return TimedWord(text, float(start), float(end))  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        pass
    message = (
        f"{shown(word, Syntax.JSON)} is not a word with its times; expected (word, start, end) in seconds"
    )
    raise InputError(message)
