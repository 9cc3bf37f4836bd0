"""A request as espeak-ng reads it: plain text, or SSML if parts of it are directed.

espeak-ng understands prosody, emphasis, break and voice; phonemes it takes as its own mnemonics between
double square brackets. Its positions count characters of what it was given, so each has its origin in the
text.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import groupby, pairwise
from typing import NamedTuple
from xml.sax.saxutils import escape, quoteattr

from ...core.choices import RATES
from ...core.directions import Break, DirectedSpan, Emphasis
from ...core.speech.voice_style import PLAIN, VoiceAdjustment
from ...errors import SpeechWarning, warn
from ...languages import Language
from .mnemonics import dictated
from .protocol import SpeechRequest

# espeak-ng's own values of its parameters, and what a semitone is of them (measured: 102, 115 and 131 Hz at a
# pitch of 50, 62.5 and 75).
USUAL_RATE, USUAL_PITCH, USUAL_RANGE, USUAL_VOLUME = 175, 50, 50, 100
PITCH_PER_SEMITONE = 6.0

# Returns the attribute of the element `voice` for the voice that a span asks for.
FindVoice = Callable[[DirectedSpan], str]


class Encoded(NamedTuple):
    """Text for espeak-ng; `origin[i]` is the index in the request's text that character i belongs to."""

    text: str
    origin: Sequence[int]
    markup: bool

    def source(self, position: int) -> int:
        """Return the index in the request's text of a position that espeak-ng reports."""
        if not self.markup:
            return position
        return self.origin[max(0, min(position, len(self.origin) - 1))]


class _Style(NamedTuple):
    manner: VoiceAdjustment
    emphasis: Emphasis | None
    voice: DirectedSpan | None
    dictated: DirectedSpan | None


def parameters(request: SpeechRequest) -> dict[str, int | None]:
    """Return espeak-ng's parameters; None leaves the voice's own."""
    manner = request.manner
    rate = request.rate
    if manner.rate != 1.0:
        rate = max(int(RATES.low), min(round((rate or USUAL_RATE) * manner.rate), int(RATES.high)))
    pitch = request.pitch
    if manner.pitch != 0.0:
        base = USUAL_PITCH if pitch is None else pitch
        pitch = max(0, min(round(base + PITCH_PER_SEMITONE * manner.pitch), 99))
    return {
        "rate": rate,
        "pitch": pitch,
        "range": None if manner.range == 1.0 else max(0, min(round(USUAL_RANGE * manner.range), 99)),
        "volume": None if manner.volume == 0.0 else _loudness(manner.volume),
    }


def encode(request: SpeechRequest, language: Language, find: FindVoice) -> Encoded:
    """Return a request's text as espeak-ng reads it; `language` is the voice's."""
    if not request.directions:
        return Encoded(request.text, (), False)
    text: list[str] = []
    origin: list[int] = []

    def put(piece: str, at: int) -> None:
        text.append(piece)
        origin.extend([at] * len(piece))

    breaks = [d for d in request.directions if isinstance(d, Break)]
    for start, end, style in _runs(request):
        for pause in (b for b in breaks if start <= b.at < end):
            put(_silence(pause), start)
        opening, closing = _tags(style, find)
        put(opening, start)
        spelling = _dictation(style.dictated, language)
        if spelling is None:
            for index in range(start, end):
                put(escape(request.text[index]), index)
        elif style.dictated is not None and style.dictated.start == start:
            # Without a blank, what follows would be read aloud.
            put(f"[[{spelling}]] ", start)
        put(closing, max(start, end - 1))
    for pause in (b for b in breaks if b.at >= len(request.text)):
        put(_silence(pause), len(request.text))
    return Encoded("".join(text), origin, True)


def _runs(request: SpeechRequest) -> Iterator[tuple[int, int, _Style]]:
    """Yield stretches [start, end) that are spoken alike; breaks begin one."""
    spans = [d for d in request.directions if isinstance(d, DirectedSpan)]
    breaks = {d.at for d in request.directions if isinstance(d, Break)}
    length = len(request.text)
    edges = sorted(
        {0, length, *breaks, *(e for s in spans for e in (s.start, s.end))} & set(range(length + 1))
    )
    pieces = [(a, b, _style(spans, a)) for a, b in pairwise(edges)]
    for _, group in groupby(pieces, key=lambda p: (p[2], sum(b <= p[0] for b in breaks))):
        run = list(group)
        yield run[0][0], run[-1][1], run[0][2]


def _style(spans: Sequence[DirectedSpan], at: int) -> _Style:
    covering = [span for span in spans if span.start <= at < span.end]
    manner = PLAIN
    for span in covering:
        manner = manner.then(span.manner)
    # Inner spans come later and override.
    emphasis = next((s.emphasis for s in reversed(covering) if s.emphasis is not None), None)
    voice = next((s for s in reversed(covering) if s.voice or s.language), None)
    dictated = next((s for s in reversed(covering) if s.phones), None)
    return _Style(manner, emphasis, voice, dictated)


def _silence(pause: Break) -> str:
    return f'<break time="{round(1000 * pause.seconds)}ms"/>'


def _dictation(span: DirectedSpan | None, language: Language) -> str | None:
    """Return the mnemonics of a span's phones; None if there are no mnemonics, or the voice takes none."""
    if span is None:
        return None
    spelling = dictated(span.phones, language)
    if spelling is None:
        message = f"{span.place}: only English voices take phonemes; the words are spoken as written"
        warn(message, SpeechWarning)
    return spelling


def _tags(style: _Style, find: FindVoice) -> tuple[str, str]:
    tags = []
    if style.voice is not None:
        tags.append(f"<voice {find(style.voice)}>")
    if style.manner != PLAIN:
        tags.append(_prosody(style.manner))
    if style.emphasis is not None:
        tags.append(f'<emphasis level="{style.emphasis}">')
    closing = "".join(f"</{tag[1:].split(' ')[0]}>" for tag in reversed(tags))
    return "".join(tags), closing


def _prosody(manner: VoiceAdjustment) -> str:
    pitch = round(100.0 * PITCH_PER_SEMITONE * manner.pitch / USUAL_PITCH)
    return (
        f'<prosody rate="{round(100.0 * manner.rate)}%" pitch="{pitch:+d}%" '
        f'range="{round(100.0 * manner.range)}%" volume="{_loudness(manner.volume)}%">'
    )


def _loudness(decibels: float) -> int:
    return max(0, min(round(USUAL_VOLUME * math.exp(decibels * math.log(10.0) / 20.0)), 200))


def voice_attribute(key: str) -> str:
    """Return the attribute of the element `voice` for espeak-ng's `key`."""
    return f"name={quoteattr(key)}"
