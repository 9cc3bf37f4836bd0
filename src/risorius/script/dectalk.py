"""Phonemes in DECtalk's ASCII notation (Digital Equipment Corporation 1985), as paper B's input uses it.

`p'aapkaorn`: codes of one or two letters without blanks, the longer one first; a stress mark stands before
its vowel; `<120>` after a phoneme is its duration in milliseconds; `_` is silence.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from ..errors import InputError, Place, unknown
from ..languages import phonesets
from .notation import Item
from .quote import quoted

# DECtalk's codes as ARPAbet with stress digits to come; some are two sounds. The table of Digital's manuals;
# reduced vowels and allophones as the nearest of CMU's 39.
CODES: dict[str, tuple[str, ...]] = {
    "iy": ("IY",), "ih": ("IH",), "ey": ("EY",), "eh": ("EH",), "ae": ("AE",), "aa": ("AA",), "ay": ("AY",),
    "aw": ("AW",), "ah": ("AH",), "ao": ("AO",), "ow": ("OW",), "oy": ("OY",), "uh": ("UH",), "uw": ("UW",),
    "rr": ("ER",), "er": ("ER",), "yu": ("Y", "UW"), "ax": ("AH",), "ix": ("IH",), "ir": ("IH", "R"), "ar":
    ("AA", "R"), "or": ("AO", "R"), "ur": ("UH", "R"), "w": ("W",), "yx": ("Y",), "y": ("Y",), "r": ("R",),
    "ll": ("L",), "l": ("L",), "hx": ("HH",), "h": ("HH",), "rx": ("R",), "lx": ("L",), "m": ("M",), "n":
    ("N",), "nx": ("NG",), "el": ("AH", "L"), "en": ("AH", "N"), "dx": ("D",), "q": ("T",), "dz": ("D",
    "Z"), "tx": ("T",), "df": ("D",), "p": ("P",), "b": ("B",), "t": ("T",), "d": ("D",), "k": ("K",), "g":
    ("G",), "f": ("F",), "v": ("V",), "th": ("TH",), "dh": ("DH",), "s": ("S",), "z": ("Z",), "sh": ("SH",),
    "zh": ("ZH",), "ch": ("CH",), "jh": ("JH",),
}  # fmt: skip
SILENCE = "_"
# ARPAbet's stress digits by DECtalk's marks: primary, secondary, emphatic.
_STRESS = {"'": "1", "`": "2", '"': "1"}
_DURATION = re.compile(r"<([^<>]*+)(>?)")
_MILLISECONDS = re.compile(r"[0-9]{1,9}")
_LONGEST_MS = 10_000


class Dictated(NamedTuple):
    """A phone, ARPAbet with a stress digit on vowels, "" for silence; its duration in seconds if given."""

    symbol: str
    seconds: float | None


@dataclass
class _Reading:
    """The state of reading an item."""

    item: Item
    at: int = 0

    @property
    def place(self) -> Place:
        place = self.item.place
        if place.column is None:
            return place
        return Place(place.file, place.line, place.column + self.at)

    def stress(self) -> str:
        mark = self.item.text[self.at : self.at + 1]
        if mark in _STRESS:
            self.at += 1
        return _STRESS.get(mark, "0")

    def code(self) -> str:
        text = self.item.text
        size = next((n for n in (2, 1) if text[self.at : self.at + n].lower() in (*CODES, SILENCE)), 0)
        if not size or self.at >= len(text):
            shown = text[self.at : self.at + 2] or text
            raise InputError(unknown("phoneme", shown, CODES), self.place)
        self.at += size
        return text[self.at - size : self.at].lower()

    def seconds(self) -> float | None:
        match = _DURATION.match(self.item.text, self.at)
        if match is None:
            return None
        written, closed = match[1], match[2]
        milliseconds = int(written) if _MILLISECONDS.fullmatch(written) else 0
        if not closed or not 0 < milliseconds <= _LONGEST_MS:
            raise InputError(
                f"{quoted(match[0])} is not a duration; expected milliseconds, e.g. <120>", self.place
            )
        self.at = match.end()
        return milliseconds / 1000.0


def read_phonemes(item: Item) -> tuple[Dictated, ...]:
    """Return the phonemes of a word; raise InputError, with line and column, for other text."""
    return tuple(_read(_Reading(item)))


def _read(reading: _Reading) -> Iterator[Dictated]:
    while reading.at < len(reading.item.text):
        stress, place = reading.stress(), reading.place
        code = reading.code()
        seconds = reading.seconds()
        if code == SILENCE:
            yield Dictated("", seconds)
            continue
        phones = CODES[code]
        if stress != "0" and not phonesets.VOWELS & set(phones):
            raise InputError(
                f"a stress mark before '{code}', which is not a vowel; expected it before one", place
            )
        share = None if seconds is None else seconds / len(phones)
        for phone in phones:
            yield Dictated(phone + stress if phone in phonesets.VOWELS else phone, share)
