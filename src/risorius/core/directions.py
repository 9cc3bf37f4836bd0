"""Directions for speaking the words of a line: spans, breaks, tones and named places, by character."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum

from ..errors import Place
from .speech.voice_style import PLAIN, VoiceAdjustment


class Emphasis(StrEnum):
    """The level of a word's emphasis (SSML 1.1, section 3.2.2)."""

    STRONG = "strong"
    MODERATE = "moderate"
    NONE = "none"
    REDUCED = "reduced"


FOCUSED = (Emphasis.STRONG, Emphasis.MODERATE)


@dataclass(frozen=True, slots=True)
class Hertz:
    """A pitch of `value` Hz; if `added`, it is added to the pitch of the voice itself."""

    value: float
    added: bool = False


@dataclass(frozen=True, slots=True)
class DirectedSpan:
    """Directions for speaking characters [start, end) of a line.

    `phones`: ARPAbet with stress digits, or IPA with stress marks, that replace the dictionary's; `seconds`:
    how long each lasts, empty if that is free. `voice`: another voice's name; `language`: the language (BCP
    47) of another voice. `pitch`: in Hz, which only the voice's own pitch makes into semitones. `spoken`: the
    words that are said in place of those written.
    """

    start: int
    end: int
    place: Place
    manner: VoiceAdjustment = PLAIN
    emphasis: Emphasis | None = None
    phones: tuple[str, ...] = ()
    seconds: tuple[float, ...] = ()
    voice: str | None = None
    language: str | None = None
    pitch: Hertz | None = None
    spoken: str | None = None


@dataclass(frozen=True, slots=True)
class Break:
    """A pause of `seconds` before character `at`; of 0 seconds, there is no pause, whatever is written."""

    at: int
    seconds: float
    place: Place


@dataclass(frozen=True, slots=True)
class ToneMark:
    """A ToBI label of the word that holds character `at`: an accent, or the boundary after the word."""

    at: int
    label: str
    place: Place


@dataclass(frozen=True, slots=True)
class Sync:
    """A named place in the text, before character `at`; if `ends`, after the word before it.

    `seconds` after the start of the line, if that is given.
    """

    name: str
    at: int
    place: Place
    ends: bool = False
    seconds: float | None = None


@dataclass(frozen=True, slots=True)
class Directions:
    """All directions of a line. `answers`: the question that it answers."""

    spans: tuple[DirectedSpan, ...] = ()
    breaks: tuple[Break, ...] = ()
    accents: tuple[ToneMark, ...] = ()
    boundaries: tuple[ToneMark, ...] = ()
    syncs: tuple[Sync, ...] = ()
    answers: str = ""

    def moved(self, characters: int) -> Directions:
        """Return the same directions for a text that begins `characters` later."""
        return Directions(
            tuple(replace(s, start=s.start + characters, end=s.end + characters) for s in self.spans),
            tuple(replace(b, at=b.at + characters) for b in self.breaks),
            tuple(replace(t, at=t.at + characters) for t in self.accents),
            tuple(replace(t, at=t.at + characters) for t in self.boundaries),
            tuple(replace(s, at=s.at + characters) for s in self.syncs),
            self.answers,
        )

    def joined(self, other: Directions) -> Directions:
        """Return all directions of both, those of `other` last."""
        return Directions(
            (*self.spans, *other.spans),
            (*self.breaks, *other.breaks),
            (*self.accents, *other.accents),
            (*self.boundaries, *other.boundaries),
            (*self.syncs, *other.syncs),
            self.answers or other.answers,
        )

    def focused(self, start: int, end: int) -> bool:
        """Return whether characters [start, end) are emphasised."""
        return any(s.emphasis in FOCUSED and s.start < end and start < s.end for s in self.spans)

    def between(self, start: int, end: int, *, last: bool = False) -> Iterator[DirectedSpan | Break]:
        """Yield the spans, cut to characters [start, end), and the breaks among them.

        `last`: also the breaks after `end`.
        """
        for span in self.spans:
            if span.start < end and start < span.end:
                yield replace(span, start=max(span.start, start), end=min(span.end, end))
        yield from (b for b in self.breaks if start <= b.at and (last or b.at < end))


UNDIRECTED = Directions()
