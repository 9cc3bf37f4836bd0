"""From an utterance file and its recording to an Utterance: phones and durations as they are written.

Paper B's own case (section 5.1): speech is recorded, and the timing of phones and pauses is read off a
spectrogram and written into the file.
"""

from __future__ import annotations

from collections.abc import Sequence

from ...core.directions import DirectedSpan, Directions
from ...core.speech.audio import Audio
from ...core.speech.utterance import SILENCE, Phone, Utterance, Word
from ...errors import InputError
from ..alignment import align
from ..assembly.retime import dictated_phones
from ..structure.build import build_utterance
from ..structure.lines import whole

LANGUAGE = "en-us"
# Seconds by which the phones may last beyond the recording: its length is rounded.
BEYOND = 0.1


def utterance_dictated(audio: Audio, text: str, directions: Directions) -> Utterance:
    """Return the utterance of a recording, by the phones and durations that `directions` give for each word.

    A pause that is written before the first word is the recording's beginning; without one the first word
    begins where the aligner hears it. Raises InputError, with its place, if the phones last longer than the
    recording.
    """
    spans = sorted((s for s in directions.spans if s.seconds), key=lambda s: s.start)
    breaks = [sum(b.seconds for b in directions.breaks if _before(b.at, spans, i)) for i in range(len(spans))]
    time = breaks[0] if breaks[0] > 0.0 else align(audio, text).words[0].start
    phones: list[Phone] = []
    words: list[Word] = []
    for number, (span, silent) in enumerate(zip(spans, breaks, strict=True)):
        edge = phones[-1].end if phones else 0.0
        time = edge + silent if number else time
        if time > edge:
            phones.append(Phone(SILENCE, edge, time))
        first = len(phones)
        for symbol, stress, seconds in dictated_phones(span):
            phones.append(Phone(symbol, time, time + seconds, stress, number))
            time = phones[-1].end
        words.append(
            Word(
                text[span.start : span.end],
                phones[first].start,
                time,
                first,
                len(phones),
                span.start,
                span.end,
            )
        )
    closed = _closed(phones, audio.duration, spans[-1])
    words[-1] = _ended(words[-1], closed)
    return build_utterance(text, LANGUAGE, audio, closed, tuple(words), (whole(text, closed, directions),))


def _before(at: int, spans: Sequence[DirectedSpan], index: int) -> bool:
    """Tell whether a break at a character comes before a word and after the one before it."""
    return at <= spans[index].start and (index == 0 or at > spans[index - 1].start)


def _closed(phones: Sequence[Phone], duration: float, last: DirectedSpan) -> tuple[Phone, ...]:
    """Return phones that fill the recording to its end."""
    end = phones[-1].end
    if end > duration + BEYOND or phones[-1].start >= duration:
        message = f"the phonemes end at {end:.3f} s, but the recording lasts {duration:.3f} s"
        raise InputError(f"{message}; expected the recording that they are timed by", last.place)
    if end < duration:
        return (*phones, Phone(SILENCE, end, duration))
    final = phones[-1]
    return (*phones[:-1], Phone(final.symbol, final.start, duration, final.stress, final.word))


def _ended(word: Word, phones: Sequence[Phone]) -> Word:
    """Return the last word, which ends with its last phone."""
    end = phones[word.last_phone - 1].end
    return Word(
        word.text, word.start, end, word.first_phone, word.last_phone, word.source_start, word.source_end
    )
