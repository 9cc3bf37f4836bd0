"""`.TextGrid`: labelled intervals and points, as Praat and forced aligners write them, read and written.

The format is a stream of free-standing numbers, quoted strings and flags; all else (names, equals signs,
indices in brackets, comments) is for the reader's eye (Praat manual, "TextGrid file formats"). So the long
and the short form are read by the same rules, and every label keeps its line. The long form is written.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from ..core.units import MAX_SECONDS
from ..errors import InputError, Place
from .files import decode, names_something, read_bytes
from .quote import LONGEST_PATH, one_line, quoted

MAX_BYTES = 64_000_000
DIGITS = 6  # of seconds, after the point, in what is written
INTERVALS, POINTS = "IntervalTier", "TextTier"
# Free-standing: not within a word such as "item[1]" or "xmin2".
_TOKEN = re.compile(
    r'"(?P<string>(?:[^"]|"")*)"|(?<![^\s])(?P<number>[-+]?(?:\d++(?:\.\d*+)?|\.\d++)(?:[eE][-+]?\d++)?%?)(?![^\s])'
    r"|(?P<flag><[a-z]+>)|(?P<comment>!.*)"
)


class Label(NamedTuple):
    """A label on [start, end] seconds, or at a point if both are the same; `line`: where it was read."""

    start: float
    end: float
    text: str
    line: int = 0


@dataclass(frozen=True, slots=True)
class Tier:
    """Labels in the order of the file; `kind` is INTERVALS or POINTS."""

    name: str
    kind: str
    labels: tuple[Label, ...]
    line: int = 0


@dataclass(frozen=True, slots=True)
class TextGrid:
    """Tiers over [start, end] seconds, and the file's name."""

    source: str
    start: float
    end: float
    tiers: tuple[Tier, ...]


def read_textgrid(path: str) -> TextGrid:
    """Return a TextGrid file's tiers; raise InputError, with the line, for anything else."""
    place = Place(one_line(path, LONGEST_PATH))
    if not names_something(path):
        raise InputError("there is no such file; expected a TextGrid", place)
    return parse_textgrid(decode(read_bytes(path, MAX_BYTES, place), place.file), place.file)


def moved(grid: TextGrid, seconds: float) -> TextGrid:
    """Return a grid all of whose times are later by `seconds`."""
    return replace(
        grid,
        start=grid.start + seconds,
        end=grid.end + seconds,
        tiers=tuple(
            replace(
                tier,
                labels=tuple(
                    label._replace(start=label.start + seconds, end=label.end + seconds)
                    for label in tier.labels
                ),
            )
            for tier in grid.tiers
        ),
    )


def parse_textgrid(text: str, source: str = "text") -> TextGrid:
    """Return the tiers of a TextGrid's text; raise InputError, with the line, for anything else."""
    stream = _Stream(text, source)
    for expected in ("ooTextFile", "TextGrid"):
        if not stream.string("the header").startswith(expected):
            raise stream.fault(f'is not a TextGrid; expected "{expected}"')
    start, end = stream.time("the start"), stream.time("the end")
    if stream.flag() != "<exists>":
        raise stream.fault("has no tiers; expected words and phones")
    count = stream.count("the number of tiers")
    return TextGrid(source, start, end, tuple(_tier(stream) for _ in range(count)))


def _tier(stream: _Stream) -> Tier:
    kind = stream.string("the tier's class")
    if kind not in (INTERVALS, POINTS):
        raise stream.fault(f"{quoted(kind)} is not a class of tiers; expected {INTERVALS} or {POINTS}")
    line = stream.line
    name = stream.string("the tier's name")
    stream.time("the tier's start")
    stream.time("the tier's end")
    labels = tuple(_label(stream, kind) for _ in range(stream.count("the number of labels")))
    return Tier(name, kind, labels, line)


def _label(stream: _Stream, kind: str) -> Label:
    start = stream.time("the label's time")
    line = stream.line
    end = stream.time("the interval's end") if kind == INTERVALS else start
    if end < start:
        raise stream.fault(f"the interval ends at {end:g} s, before it starts at {start:g} s")
    return Label(start, end, stream.string("the label"), line)


class _Stream:
    """The tokens of a file one by one, and the line of the last."""

    def __init__(self, text: str, source: str) -> None:
        self._tokens = self._found(text)
        self._source = source
        self.line = 1

    def _found(self, text: str) -> Iterator[re.Match[str]]:
        reached, line = 0, 1
        for match in _TOKEN.finditer(text):
            line += text.count("\n", reached, match.start())
            reached = match.start()
            if match["comment"] is None:
                self.line = line
                yield match

    def _next(self, kind: str, what: str) -> str:
        match = next(self._tokens, None)
        if match is None:
            raise self.fault(f"the file ends before {what}; expected a whole TextGrid")
        if match.lastgroup != kind:
            raise self.fault(f"{quoted(match.group())} stands in place of {what}; expected a {kind}")
        return match[kind]

    def string(self, what: str) -> str:
        return self._next("string", what).replace('""', '"')

    def number(self, what: str) -> float:
        number = float(self._next("number", what).rstrip("%"))
        if not math.isfinite(number):
            raise self.fault(f"{what} is too large; expected a finite number")
        return number

    def time(self, what: str) -> float:
        seconds = self.number(what)
        if not abs(seconds) <= MAX_SECONDS:
            raise self.fault(f"{what} is {seconds:g} s; expected at most {MAX_SECONDS:g} s")
        return seconds

    def flag(self) -> str:
        return self._next("flag", "<exists>")

    def count(self, what: str) -> int:
        number = self.number(what)
        if number < 0 or number != int(number):
            raise self.fault(f"{what} is {number:g}; expected a whole number")
        return int(number)

    def fault(self, message: str) -> InputError:
        return InputError(message, Place(self._source, self.line))


def textgrid_lines(duration: float, tiers: Sequence[Tier]) -> Iterator[str]:
    """Yield the lines of a TextGrid over [0, `duration`] seconds, its times rounded to 1e-6 s.

    Intervals follow one another in each tier; what lies between them is filled with empty ones, because Praat
    accepts no gaps. An interval that the rounding leaves nothing of is left out. Lines with a value end in a
    blank, as Praat writes them: there are readers that cut at it.
    """
    end = _rounded(duration)
    yield from ('File type = "ooTextFile"', 'Object class = "TextGrid"', "")
    yield from _span_lines("", end)
    yield from ("tiers? <exists> ", f"size = {len(tiers)} ", "item []: ")
    for number, tier in enumerate(tiers, 1):
        yield f"    item [{number}]:"
        yield f'        class = "{tier.kind}" '
        yield f"        name = {_written(tier.name)} "
        yield from _span_lines("        ", end)
        yield from (_interval_lines if tier.kind == INTERVALS else _point_lines)(tier, end)


def _interval_lines(tier: Tier, end: float) -> Iterator[str]:
    intervals = list(_filled(tier.labels, end))
    yield f"        intervals: size = {len(intervals)} "
    for number, label in enumerate(intervals, 1):
        yield f"        intervals [{number}]:"
        yield f"            xmin = {_number(label.start)} "
        yield f"            xmax = {_number(label.end)} "
        yield f"            text = {_written(label.text)} "


def _point_lines(tier: Tier, _end: float) -> Iterator[str]:
    yield f"        points: size = {len(tier.labels)} "
    for number, label in enumerate(tier.labels, 1):
        yield f"        points [{number}]:"
        yield f"            number = {_number(_rounded(label.start))} "
        yield f"            mark = {_written(label.text)} "


def _span_lines(indent: str, end: float) -> Iterator[str]:
    yield f"{indent}xmin = 0 "
    yield f"{indent}xmax = {_number(end)} "


def _filled(labels: Iterable[Label], end: float) -> Iterator[Label]:
    """Yield intervals that cover [0, end] without a gap."""
    reached = 0.0
    for label in labels:
        start, stop = max(_rounded(label.start), reached), min(_rounded(label.end), end)
        if start >= stop:
            continue
        if start > reached:
            yield Label(reached, start, "")
        yield Label(start, stop, label.text)
        reached = stop
    if reached < end:
        yield Label(reached, end, "")


def _rounded(seconds: float) -> float:
    return round(seconds, DIGITS)


def _number(seconds: float) -> str:
    return f"{seconds:.{DIGITS}f}".rstrip("0").rstrip(".")


def _written(text: str) -> str:
    """Return a string as the format quotes it, on one line."""
    flat = " ".join(text.split())
    return '"' + flat.replace('"', '""') + '"'
