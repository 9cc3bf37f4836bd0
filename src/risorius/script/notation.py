"""Phrases in brackets, as paper B writes them: `(JUlia prefers) (POPcorn)` and `(L+H* LH%) (H* LL%)`.

Capitals mark the accented words of a text; each bracket of tones has an accent for each of them in turn,
then the boundary of its phrase.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, zip_longest

from ..core.directions import DirectedSpan, Directions, ToneMark
from ..core.speech.tobi import boundary_tone, pitch_accent
from ..core.speech.voice_style import PLAIN, VoiceAdjustment
from ..errors import InputError, ParameterError, Place
from ..languages import language_of
from ..languages.intonation import Voicing
from .quote import quoted

# The notation is of English.
_LANGUAGE = "en"
EXAMPLE = "(JUlia prefers) (POPcorn)"
_ITEM = re.compile(r"[^\s()]+")
_BRACKETED = re.compile(r"[()]")
SPOKEN_WORD = re.compile(r"[^\W_](?:[\w'’.-]*[^\W_])?")
PUNCTUATION = ",.;:?!…"
_CAPITALS = re.compile(r"[A-ZÀ-ÖØ-Þ]{2}|^[A-ZÀ-ÖØ-Þ]$")


@dataclass(frozen=True, slots=True)
class Item:
    """A text between blanks, with its place."""

    text: str
    place: Place


@dataclass(frozen=True, slots=True)
class Bracket:
    """A pair of brackets: its items, its place, and the text after it up to the next."""

    items: tuple[Item, ...]
    place: Place
    after: str


def has_brackets(text: str) -> bool:
    """Tell whether a text is written in brackets, balanced or not."""
    return "(" in text or ")" in text


def read_brackets(text: str, place: Place) -> tuple[Bracket, ...]:
    """Return the brackets of a text of one line that begins at `place`.

    Raises InputError, with line and column, for brackets that are not balanced, nested, or empty, and for
    words outside them.
    """
    brackets: list[Bracket] = []
    opened: int | None = None
    edges = [*_BRACKETED.finditer(text)]
    outside = text[: edges[0].start()] if edges else text
    if outside.strip():
        raise InputError(f"{quoted(outside.strip())} stands outside brackets; expected {EXAMPLE}", place)
    for number, edge in enumerate(edges):
        here = _at(place, edge.start())
        if (edge[0] == "(") == (opened is not None):
            problem = "opens inside another" if edge[0] == "(" else "closes nothing"
            raise InputError(f"'{edge[0]}' {problem}; expected {EXAMPLE}", here)
        if edge[0] == "(":
            opened = edge.start()
            continue
        assert opened is not None
        stop = edges[number + 1].start() if number + 1 < len(edges) else len(text)
        after = text[edge.end() : stop].strip()
        if any(char.isalnum() for char in after):
            raise InputError(f"{quoted(after)} stands outside brackets; expected {EXAMPLE}", here)
        items = tuple(_items(text, opened + 1, edge.start(), place))
        if not items:
            raise InputError(f"empty brackets; expected {EXAMPLE}", _at(place, opened))
        brackets.append(Bracket(items, _at(place, opened), after))
        opened = None
    if opened is not None:
        raise InputError("'(' is not closed; expected ')'", _at(place, opened))
    return tuple(brackets)


def _items(text: str, start: int, stop: int, place: Place) -> Iterator[Item]:
    for match in _ITEM.finditer(text, start, stop):
        yield Item(match[0], _at(place, match.start()))


def _at(place: Place, index: int) -> Place:
    if place.column is None:
        return place
    return Place(place.file, place.line, place.column + index)


@dataclass(frozen=True, slots=True)
class Tune:
    """The tones of one phrase: its accents, and the boundary, "" if none is written."""

    accents: tuple[tuple[str, Place], ...]
    boundary: str
    place: Place


def read_tune(bracket: Bracket) -> Tune:
    """Return a bracket of tones; raise ParameterError, with its place, for an unknown one."""
    accents: list[tuple[str, Place]] = []
    boundary = ""
    for item in bracket.items:
        if boundary:
            raise InputError(f"'{item.text}' comes after the boundary; expected it to be last", item.place)
        try:
            if "*" in item.text:
                accents.append((pitch_accent(item.text), item.place))
            else:
                boundary = boundary_tone(item.text)
        except ParameterError as error:
            raise error.at(item.place) from None
    return Tune(tuple(accents), boundary, bracket.place)


@dataclass(frozen=True, slots=True)
class Written:
    """A text without its brackets, what it says about its speaking, and the span of each phrase's words."""

    text: str
    directions: Directions
    words: tuple[tuple[tuple[int, int], ...], ...]


def write_out(phrases: Sequence[Bracket], tunes: Sequence[Tune]) -> Written:
    """Return the text of `phrases` under `tunes`, of which there may be none.

    If a phrase ends without punctuation, its boundary gives some, so that the voice ends it so. Raises
    InputError, with the place, if brackets or accents do not pair.
    """
    if tunes and len(tunes) != len(phrases):
        at = tunes[min(len(phrases), len(tunes)) - 1].place
        raise InputError(f"{len(tunes)} brackets of tones for {len(phrases)} of words; expected one each", at)
    text = ""
    directions = Directions()
    words: list[tuple[tuple[int, int], ...]] = []
    for phrase, tune in zip_longest(phrases, tunes):
        text += " " if text else ""
        part = _phrase(phrase, tune or Tune((), "", phrase.place), first=not text)
        directions = directions.joined(part.directions.moved(len(text)))
        words += [tuple((a + len(text), b + len(text)) for a, b in spans) for spans in part.words]
        text += part.text
    return Written(text, directions, tuple(words))


def _phrase(phrase: Bracket, tune: Tune, *, first: bool) -> Written:
    """Return one phrase; `first`: it begins the text."""
    spelled = [_spell(item.text, first=first and k == 0) for k, item in enumerate(phrase.items)]
    placed = [
        (start + m.start(), start + m.end(), item)
        for start, item, word in zip(_starts(spelled), phrase.items, spelled, strict=True)
        for m in SPOKEN_WORD.finditer(word)
    ]
    if not placed:
        raise InputError("no word in these brackets; expected one", phrase.place)
    accented = list(zip(tune.accents, _accented(placed, tune), strict=True))
    directions = Directions(
        spans=tuple(DirectedSpan(*span, where, accent_manner(label)) for (label, where), span in accented),
        accents=tuple(ToneMark(start, label, where) for (label, where), (start, _) in accented),
        boundaries=(ToneMark(placed[-1][0], tune.boundary, tune.place),) if tune.boundary else (),
    )
    text = " ".join(spelled) + (phrase.after or closing_mark(tune.boundary, spelled[-1]))
    return Written(text, directions, (tuple((a, b) for a, b, _ in placed),))


def _spell(word: str, *, first: bool) -> str:
    """Return a word without the capitals that mark an accent."""
    if not _is_marked(word):
        return word
    return word.capitalize() if first else word.lower()


def _is_marked(word: str) -> bool:
    return bool(_CAPITALS.search(word)) and word not in ("I", "A")


def _starts(words: Sequence[str]) -> list[int]:
    """Return where each word begins, one blank between them."""
    return [0, *accumulate(len(word) + 1 for word in words[:-1])]


def _accented(placed: Sequence[tuple[int, int, Item]], tune: Tune) -> list[tuple[int, int]]:
    """Return the accented words of a phrase: those in capitals, or without capitals, the last ones."""
    marked = [(a, b) for a, b, item in placed if _is_marked(item.text)]
    if not marked:
        marked = [(a, b) for a, b, _ in placed][-len(tune.accents) :] if tune.accents else []
    if tune.accents and len(marked) != len(tune.accents):
        message = f"{len(tune.accents)} accents for {len(marked)} accented words; expected one each"
        raise InputError(message, tune.place)
    return marked if tune.accents else []


def accent_manner(label: str) -> VoiceAdjustment:
    """Return how a voice speaks a word with this accent."""
    semitones = _voicing().accents.get(label, 0.0)
    return VoiceAdjustment(pitch=semitones) if semitones else PLAIN


def closing_mark(boundary: str, last: str) -> str:
    """Return the punctuation that makes a voice end a phrase so, "" if `last`, its last word, has some."""
    return "" if last[-1:] in PUNCTUATION else _voicing().boundaries.get(boundary, "")


def _voicing() -> Voicing:
    return language_of(_LANGUAGE).intonation.voice
