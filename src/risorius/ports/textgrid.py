"""`.TextGrid`: words, phones, accents and boundaries for Praat and aligners, long form, UTF-8."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from ..core.utterance import Phone, Utterance
from ..errors import OutputError
from .formats import register
from .table import write_lines
from .writable import WritableTake, WriteOptions

Interval = tuple[float, float, str]
Point = tuple[float, str]

# ARPAbet writes primary stress 1 and secondary 2; Phone.stress counts upwards with strength.
_STRESS_DIGIT = {0: "0", 1: "2", 2: "1"}


def write_textgrid(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write tiers `words`, `phones`, `accents` and `boundaries`. Raises OutputError if nothing is said."""
    if take.utterance is None:
        raise OutputError("there is nothing said to write; expected a performance that speaks")
    write_lines(path, textgrid_lines(take.utterance))


def textgrid_lines(utterance: Utterance) -> Iterator[str]:
    """Yield the lines of a TextGrid; times are rounded to 1e-6 s."""
    end = _rounded(utterance.duration)
    words = [(w.start, w.end, w.text) for w in utterance.words]
    phones = [(p.start, p.end, phone_label(p, utterance.language)) for p in utterance.phones]
    accents = [(a.time, a.label) for a in utterance.accents]
    boundaries = [(b.time, b.label) for b in utterance.boundaries]
    tiers = [("words", words), ("phones", phones)]
    yield from _head(end, 4)
    yield from _interval_tiers(end, tiers)
    yield from _point_tier(3, "accents", end, accents)
    yield from _point_tier(4, "boundaries", end, boundaries)


def grid_lines(duration: float, tiers: list[tuple[str, list[Interval]]]) -> Iterator[str]:
    """Yield the lines of a TextGrid of interval tiers, each a name and its intervals in order."""
    end = _rounded(duration)
    yield from _head(end, len(tiers))
    yield from _interval_tiers(end, tiers)


def _head(end: float, size: int) -> Iterator[str]:
    yield 'File type = "ooTextFile"'
    yield 'Object class = "TextGrid"'
    yield ""
    yield from _span("", end)
    yield "tiers? <exists>"
    yield f"size = {size}"
    yield "item []:"


def _interval_tiers(end: float, tiers: list[tuple[str, list[Interval]]]) -> Iterator[str]:
    for number, (name, marked) in enumerate(tiers, 1):
        yield from _interval_tier(number, name, end, marked)


def phone_label(phone: Phone, language: str) -> str:
    """Return a phone as aligners write it: ARPAbet with a stress digit on English vowels, else IPA."""
    english = language.lower().split("-")[0].split("_")[0] == "en"
    return phone.symbol + (_STRESS_DIGIT[phone.stress] if english and phone.stress >= 0 else "")


def _interval_tier(number: int, name: str, end: float, marked: Iterable[Interval]) -> Iterator[str]:
    intervals = list(_filled(marked, end))
    yield from _tier_head(number, "IntervalTier", name, end)
    yield f"        intervals: size = {len(intervals)}"
    for k, (start, stop, text) in enumerate(intervals, 1):
        yield f"        intervals [{k}]:"
        yield f"            xmin = {_number(start)}"
        yield f"            xmax = {_number(stop)}"
        yield f"            text = {_quoted(text)}"


def _point_tier(number: int, name: str, end: float, points: list[Point]) -> Iterator[str]:
    yield from _tier_head(number, "TextTier", name, end)
    yield f"        points: size = {len(points)}"
    for k, (time, mark) in enumerate(points, 1):
        yield f"        points [{k}]:"
        yield f"            number = {_number(_rounded(time))}"
        yield f"            mark = {_quoted(mark)}"


def _tier_head(number: int, kind: str, name: str, end: float) -> Iterator[str]:
    yield f"    item [{number}]:"
    yield f'        class = "{kind}"'
    yield f"        name = {_quoted(name)}"
    yield from _span("        ", end)


def _span(indent: str, end: float) -> Iterator[str]:
    yield f"{indent}xmin = 0"
    yield f"{indent}xmax = {_number(end)}"


def _filled(marked: Iterable[Interval], end: float) -> Iterator[Interval]:
    """Yield intervals that cover [0, end] without a gap: Praat accepts no other tier."""
    reached = 0.0
    for raw_start, raw_stop, text in marked:
        start, stop = max(_rounded(raw_start), reached), min(_rounded(raw_stop), end)
        if start >= stop:
            continue
        if start > reached:
            yield reached, start, ""
        yield start, stop, text
        reached = stop
    if reached < end:
        yield reached, end, ""


def _rounded(seconds: float) -> float:
    return round(seconds, 6)


def _number(seconds: float) -> str:
    return f"{seconds:.6f}".rstrip("0").rstrip(".")


def _quoted(text: str) -> str:
    flat = " ".join(text.split())
    return '"' + flat.replace('"', '""') + '"'


register(".TextGrid", "words, phones and accents for Praat", {"speech"}, write_textgrid, order=8)
