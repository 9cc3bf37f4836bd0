"""Times in a script: seconds, or relative to a word or to the end of the performance."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

from ..core.speech.utterance import Word
from ..core.units import MAX_SECONDS
from ..errors import InputError, Place
from .quote import quoted

# Without going back into the digits: that would take a time that grows with their square.
NUMBER = r"(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][+-]?\d++)?"
_ANCHOR = re.compile(
    rf"(?:word:(?P<word>\d{{1,7}})(?P<edge>\.start|\.end)?|(?P<end>end))(?:\s*+(?P<sign>[+-])\s*+(?P<offset>{NUMBER}))?",
    re.ASCII | re.IGNORECASE,
)
_NUMBER = re.compile(rf"[+-]?{NUMBER}", re.ASCII)


class Base(StrEnum):
    """The base that an anchor counts from."""

    START = "start"
    WORD = "word"
    WORD_END = "word end"
    TEXT = "text"
    TEXT_END = "text end"
    END = "end"


@dataclass(frozen=True, slots=True)
class Anchor:
    """`seconds` after the start or end of the performance, or of word number `word` (from 1).

    `TEXT` is the start of the first word at or after character `character` of the script's text, `TEXT_END`
    the end of the last word before it.
    """

    base: Base
    seconds: float
    word: int = 0
    character: int = 0
    place: Place | None = field(default=None, compare=False)

    def after(self, seconds: float) -> Anchor:
        """Return the anchor that lies `seconds` later."""
        return replace(self, seconds=self.seconds + seconds)

    def same_base(self, other: Anchor) -> bool:
        """Whether both count from the same moment, so that their distance is known without the speech."""
        return (self.base, self.word, self.character) == (other.base, other.word, other.character)

    def resolve(self, words: Sequence[Word], duration: float) -> float:
        """Return the time in seconds in an utterance of these words, in a performance of `duration` seconds.

        Raises InputError, with the place, for a word that does not exist and for a time before the start or
        later than a performance lasts.
        """
        moment = self._origin(words, duration) + self.seconds
        if moment < 0.0:
            raise InputError(f"'{self}' is {-moment:.3f} s before the start", self.place)
        if moment > MAX_SECONDS:
            raise InputError(f"'{self}' is {moment:g} s; expected at most {MAX_SECONDS:g} s", self.place)
        return moment

    def _origin(self, words: Sequence[Word], duration: float) -> float:
        if self.base is Base.START:
            return 0.0
        if self.base is Base.END:
            return duration
        if self.base in (Base.TEXT, Base.TEXT_END):
            return self._in_text(words)
        if not 1 <= self.word <= len(words):
            known = f"words 1 to {len(words)}" if words else "none: the script has no words"
            raise InputError(f"'{self}': there is no word {self.word}; expected {known}", self.place)
        word = words[self.word - 1]
        return word.start if self.base is Base.WORD else word.end

    def _in_text(self, words: Sequence[Word]) -> float:
        if not words:
            raise InputError("the time depends on the speech, but the script has no words", self.place)
        following = bisect_left(words, self.character, key=lambda word: word.source_start)
        if self.base is Base.TEXT_END:
            return words[following - 1].end if following else words[0].start
        return words[following].start if following < len(words) else words[-1].end

    def __str__(self) -> str:
        if self.base is Base.START:
            return f"{self.seconds:g}"
        name = {
            Base.WORD: f"word:{self.word}",
            Base.WORD_END: f"word:{self.word}.end",
            Base.TEXT: f"character {self.character}",
            Base.TEXT_END: f"end of character {self.character}",
        }.get(self.base, "end")
        return name + (f"{self.seconds:+g}" if self.seconds else "")


def parse_number(text: str) -> float | None:
    """Return a decimal number in ASCII digits; None for any other text (also `nan`, `inf`, `1_000`)."""
    stripped = text.strip()
    if not _NUMBER.fullmatch(stripped):
        return None
    number = float(stripped)
    return number if abs(number) < float("inf") else None


def parse_anchor(name: str, text: str, place: Place | None = None) -> Anchor:
    """Return the anchor that the attribute `name` gives: seconds, `word:3`, `word:3.end`, `end-0.5`.

    Raises InputError, with the place, for other text, and for a time before the start or beyond the longest
    performance.
    """
    anchor = _seconds(text, place) or _relative(text, place)
    if anchor is None:
        raise InputError(
            f"{name} = {quoted(text)} is not a time; expected seconds, word:3, word:3.end or end-0.5", place
        )
    if anchor.base is Base.START and anchor.seconds < 0.0:
        raise InputError(f"{name} = {quoted(text)} is negative; expected 0 or more seconds", place)
    if abs(anchor.seconds) > MAX_SECONDS:
        raise InputError(
            f"{name} = {quoted(text)} is too long; expected at most {MAX_SECONDS:.0f} seconds", place
        )
    return anchor


def _seconds(text: str, place: Place | None) -> Anchor | None:
    number = parse_number(text)
    return None if number is None else Anchor(Base.START, number, place=place)


def _relative(text: str, place: Place | None) -> Anchor | None:
    match = _ANCHOR.fullmatch(text.strip())
    if match is None:
        return None
    seconds = float(f"{match['sign']}{match['offset']}") if match["offset"] else 0.0
    if match["end"]:
        return Anchor(Base.END, seconds, place=place)
    at_end = (match["edge"] or "").lower() == ".end"
    return Anchor(Base.WORD_END if at_end else Base.WORD, seconds, int(match["word"]), place=place)
