"""Dates, times, fractions, signs and addresses: stretches of a text that people say otherwise than written.

`readings.toml` of a language has its table. A language whose words for these depend on what stands around has
`readings.py` with rules of its own, which come first, and `numbers.py` with its words for numbers.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import NamedTuple

from .abbreviations import ReadText, Replacement
from .load import module_of, read_table

_GROUPS = re.compile(r"(?<![\d.,/:-])\d{1,3}(?:[ \u00a0\u2009\u202f]\d{3})+(?![\d/:-]|[.,]\d{3}\b)")
_ISO = re.compile(
    r"(?<![\w/.-])(?P<year>[12]\d{3})-(?P<month>0[1-9]|1[0-2])-(?P<day>0[1-9]|[12]\d|3[01])"
    r"(?:T(?P<hour>[01]\d|2[0-3])(?P<sign>:)(?P<minute>[0-5]\d)(?::(?P<second>[0-5]\d))?)?(?![\w/-]|:\d)"
)
_NUMERIC = re.compile(
    r"(?<![\w/.-])(?P<first>\d{1,2})(?P<sign>[/.-])(?P<second>\d{1,2})(?P=sign)(?P<year>[12]\d{3}|\d{2})(?![\w/-]|\.\d)"
)
_TIME = re.compile(
    r"(?<![\w:.,/-])(?P<hour>[01]?\d|2[0-4])(?P<sign>[:.h])(?P<minute>[0-5]\d)(?::(?P<second>[0-5]\d))?(?![\w:/-]|[.,]\d)"
)
_FRACTION = re.compile(r"(?P<whole>(?<![\d.,])\d{1,6}[ \u00a0]?)?(?P<sign>[\u00bc-\u00be\u2150-\u215e])")
_SLASHED = re.compile(r"(?<![\w./:-])(\d{1,4} )?(\d{1,2}/\d{1,2})(?![\w/-]|[.,]\d)")
_RANGE = re.compile(r"(?<![\w.,/:-])(\d{1,4})-(\d{1,4})(?![\w/:-]|[.,]\d)")
_EMAIL = re.compile(r"(?<![\w.+-])[\w.+-]{1,64}@[\w-]{1,63}(?:\.[\w-]{1,63}){1,5}(?!\w)")
_URL = re.compile(
    r"(?<![\w@./])(?:https?://|www\.)[^\s<>\"\u201c\u201d\u00ab\u00bb]{1,300}[^\s<>\"\u201c\u201d\u00ab\u00bb.,;:!?)\]}'\u2019\u2026*/]",
    re.IGNORECASE,
)
_MINUS = re.compile(r"(?<![\w).,-])[-\u2212](\d[\d.,]*(?<=\d))(?![\w/:-])")
# Digits of other scripts are read as the European ones.
_OTHER_DIGIT = re.compile(r"(?![0-9])\d")
_PHONE = re.compile(
    r"(?<![\w+])\+(?=(?:[ \u00a0()-]{0,2}\d){7})"
    r"\d{1,3}(?:[ \u00a0-](?:\d{1,9}|\(\d{1,5}\))){2,6}(?![\w-]|[.,]\d)"
)
_STAR = re.compile(r"(?<=\d)[ \u00a0]?\*(?=[ \u00a0]?\d)")
_ARROW = re.compile(r"[\u2190-\u21ff\u2794-\u27be\u27f5-\u27ff]")
_VULGAR = {
    "\u00bd": (1, 2), "\u00bc": (1, 4), "\u00be": (3, 4), "\u2153": (1, 3), "\u2154": (2, 3),
    "\u2155": (1, 5), "\u2156": (2, 5), "\u2157": (3, 5), "\u2158": (4, 5), "\u2159": (1, 6),
    "\u215a": (5, 6), "\u2150": (1, 7), "\u215b": (1, 8), "\u215c": (3, 8), "\u215d": (5, 8),
    "\u215e": (7, 8), "\u2151": (1, 9), "\u2152": (1, 10),
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class DateTable:
    """The words of a date. `order`: of the numbers in 4/23/2021: `mdy` or `dmy`; `signs`: those between them.

    `template` has {day}, {month} and {year}; `days`: words for the days, if they are not their numbers, or
    `first` for the first one alone.
    """

    months: tuple[str, ...] = ()
    days: tuple[str, ...] = ()
    first: str = ""
    template: str = ""
    order: str = "dmy"
    signs: str = "/."


@dataclass(frozen=True, slots=True)
class TimeTable:
    """The words of a time of day, with {hour}, {minute} and {second}.

    `full`: without minutes, `one`: so at 1, `late`: so after 12.
    `hours`: words for hours, if they are not their numbers. `signs`: those between hour and minute. `unit`:
    what may follow the number and is in the words already. A point is the sign of a time only before the unit
    or after one of the words `after`.
    """

    template: str = ""
    full: str = ""
    one: str = ""
    late: str = ""
    seconds: str = ""
    hours: Mapping[str, str] = field(default_factory=dict)
    signs: str = ":"
    unit: str = ""
    after: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ReadingTable:
    """The file `readings.toml`.

    `signs`: the words of a sign; `between`: of one between numbers or words, else it is silent. `fractions`:
    words by "1/2"; `joint`: between a whole number and a fraction. `address`: the words of signs in an
    address. `group`: what stands between the thousands that the voice reads. `units` and `currencies`: names
    of one and of several, of money also of hundredths; `scales` may follow an amount. `range`: between two
    numbers. `own`: tables of the language's own rules.
    `minus`: before a number below zero, else as the sign between numbers. `money`, its `cents` and
    `measures`: names by sign, in the order of the plurals of the language.
    """

    dates: DateTable = DateTable()
    times: TimeTable = TimeTable()
    signs: Mapping[str, str] = field(default_factory=dict)
    between: Mapping[str, str] = field(default_factory=dict)
    fractions: Mapping[str, str] = field(default_factory=dict)
    joint: str = ""
    address: Mapping[str, str] = field(default_factory=dict)
    group: str = ""
    units: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    currencies: Mapping[str, tuple[str, str, str, str]] = field(default_factory=dict)
    scales: Mapping[str, str] = field(default_factory=dict)
    range: str = ""
    minus: str = ""
    money: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    cents: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    measures: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    own: Mapping[str, Mapping[str, str]] = field(default_factory=dict)


class NumberWords(NamedTuple):
    """How a language says numbers; without words of its own the voice reads the digits.

    `day` of a date, with the text before it; `minute` of a time.
    """

    year: Callable[[int], str] = str
    minute: Callable[[int], str] = str
    hour: Callable[[int], str] = str
    day: Callable[[int, str], str] = lambda number, before: str(number)


AS_DIGITS = NumberWords()
Pieces = Sequence[ReadText] | None
# Returns what is read in place of a match; None if it is to be read as it stands.
ReadMatch = Callable[[re.Match[str]], Pieces]


class ReadingRule(NamedTuple):
    """A pattern, and what is read in place of its matches."""

    pattern: re.Pattern[str]
    read: ReadMatch


@dataclass(frozen=True)
class SpokenReadings:
    """The readings of a language: its `table`, its `numbers` and its own rules."""

    table: ReadingTable = ReadingTable()
    numbers: NumberWords = AS_DIGITS
    own: tuple[ReadingRule, ...] = ()

    def of(self, text: str, variant: str = "") -> tuple[Replacement, ...]:
        """Return what of a text is said otherwise than it is written, in order.

        `variant`: the language with its country ("en-gb"), which decides the order of dates. A stretch holds
        words of the text: each text that is read in it belongs to one word.
        """
        text = _OTHER_DIGIT.sub(lambda match: str(unicodedata.decimal(match[0])), text)
        taken: list[Replacement] = []
        covered = bytearray(len(text))
        for pattern, read in (*self.own, *self.rules(variant)):
            for match in pattern.finditer(text):
                start, end = match.span()
                if start == end or any(covered[start:end]):
                    continue
                pieces = read(match)
                if pieces is not None:
                    covered[start:end] = b"\1" * (end - start)
                    taken.append(Replacement(start, end, tuple(pieces), joined=True))
        return tuple(sorted(taken))

    def rules(self, variant: str = "") -> Iterable[ReadingRule]:
        """Return the rules of the table; `variant` as in `of`."""
        months_first = self.table.dates.order == "mdy" and not variant.startswith(_DAY_FIRST)
        return self._month_first if months_first else self._day_first

    @cached_property
    def _month_first(self) -> tuple[ReadingRule, ...]:
        return tuple(_rules(self, month_first=True))

    @cached_property
    def _day_first(self) -> tuple[ReadingRule, ...]:
        return tuple(_rules(self, month_first=False))


@cache
def readings_of(code: str) -> SpokenReadings:
    """Return the readings of the language with the folder `code`."""
    table = read_table(ReadingTable, code, "readings.toml")
    module = module_of(code, "readings")
    if module is None:
        return SpokenReadings(table)
    return SpokenReadings(table, module.NUMBERS, tuple(module.rules(table)))


# English with the day first in numbers.
_DAY_FIRST = ("en-gb", "en-029")


def _rules(readings: SpokenReadings, *, month_first: bool) -> Iterator[ReadingRule]:
    table = readings.table
    yield ReadingRule(_PHONE, _phone)
    if table.address:
        yield ReadingRule(_EMAIL, lambda match: _address(match, table))
        yield ReadingRule(_URL, lambda match: _address(match, table))
    if table.dates.months:
        yield ReadingRule(_ISO, lambda match: _iso_date(match, readings))
        yield ReadingRule(_NUMERIC, lambda match: _numeric_date(match, readings, month_first))
    if table.times.template:
        yield ReadingRule(_time_pattern(table.times), lambda match: _time(match, readings))
    if table.fractions:
        yield ReadingRule(_FRACTION, lambda match: _fraction(match, table))
        yield ReadingRule(_SLASHED, lambda match: _slashed(match, table))
    if table.range:
        yield ReadingRule(_RANGE, lambda match: ((f"{match[1]} {table.range} {match[2]}", match.start()),))
    yield ReadingRule(_GROUPS, lambda match: _joined_groups(match, table))
    if "\u2212" in table.between:
        minus = table.minus or table.between["\u2212"]
        yield ReadingRule(_MINUS, lambda match: ((f"{minus} {match[1]}", match.start()),))
    if table.between:
        yield ReadingRule(_between(table.between), lambda match: _sign_between(match, table))
    times = table.between.get("\u00d7")
    if times:
        yield ReadingRule(_STAR, lambda match: ((f" {times} ", match.start()),))
    yield ReadingRule(_ARROW, lambda match: ((" ", match.start()),))
    if table.signs:
        signs = any_of(table.signs)
        yield ReadingRule(re.compile(signs), lambda match: ((f" {table.signs[match[0]]} ", match.start()),))


def any_of(entries: Iterable[str]) -> str:
    """Return a pattern of one of the texts, the longest first."""
    return "|".join(re.escape(key) for key in sorted(entries, key=len, reverse=True))


def _between(entries: Iterable[str]) -> re.Pattern[str]:
    return re.compile(
        rf"(?:(?<=[\w)%°\"'”’])|(?<=[\w)%°\"'”’] ))(?P<sign>{any_of(entries)})(?=[ \u00a0]?[\w(\"'“$€£+-])"
    )


def _sign_between(match: re.Match[str], table: ReadingTable) -> Pieces:
    return ((f" {table.between[match['sign']]} ", match.start()),)


def _phone(match: re.Match[str]) -> Pieces:
    """Read an international number of a telephone digit by digit."""
    groups = re.findall(r"\d+", match[0])
    return (("+" + ", ".join(" ".join(group) for group in groups), match.start()),)


def _joined_groups(match: re.Match[str], table: ReadingTable) -> Pieces:
    return ((re.sub(r"\D", table.group, match[0]), match.start()),)


def _iso_date(match: re.Match[str], readings: SpokenReadings) -> Pieces:
    date = _date(match, readings, int(match["day"]), int(match["month"]), int(match["year"]))
    if date is None or match["hour"] is None:
        return date
    times = readings.table.times
    time = _time(match, readings) if ":" in times.signs and times.template else None
    return None if time is None else ((f"{date[0][0]}, {time[0][0]}", match.start()),)


def _numeric_date(match: re.Match[str], readings: SpokenReadings, month_first: bool) -> Pieces:
    if match["sign"] not in readings.table.dates.signs:
        return None
    first, second, year = int(match["first"]), int(match["second"]), int(match["year"])
    if len(match["year"]) == len("21"):
        if match["sign"] == "-":
            return None
        year += 2000 if year < 50 else 1900
    day, month = (second, first) if month_first else (first, second)
    if month > 12 >= day:
        day, month = month, day
    return _date(match, readings, day, month, year)


def _date(match: re.Match[str], readings: SpokenReadings, day: int, month: int, year: int) -> Pieces:
    dates, numbers = readings.table.dates, readings.numbers
    if not (1 <= day <= 31 and 1 <= month <= 12):
        return None
    before = match.string[max(0, match.start() - 20) : match.start()]
    said = dates.days[day - 1] if dates.days else numbers.day(day, before)
    said = dates.first if day == 1 and dates.first else said
    words = dates.template.format(day=said, month=dates.months[month - 1], year=numbers.year(year))
    return ((words, match.start()),)


def _time_pattern(times: TimeTable) -> re.Pattern[str]:
    if not times.unit:
        return _TIME
    return re.compile(_TIME.pattern.rstrip() + rf"(?P<unit>[ \u00a0]?(?:{times.unit})(?!\w))?")


def _time(match: re.Match[str], readings: SpokenReadings) -> Pieces:
    times, numbers = readings.table.times, readings.numbers
    unit = match.groupdict().get("unit")
    if match["sign"] not in times.signs or (match["sign"] == "." and not (unit or _is_after(match, times))):
        return None
    hour, minute = int(match["hour"]), int(match["minute"])
    words = {
        "hour": times.hours.get(str(hour), numbers.hour(hour)),
        "minute": numbers.minute(minute),
        "second": str(int(match["second"] or 0)),
    }
    full = times.one if times.one and hour == 1 else times.full
    full = times.late if times.late and not 1 <= hour <= 12 else full
    template = times.seconds if match["second"] else full if minute == 0 else times.template
    said = template.format(**words)
    if unit is None:
        return ((said, match.start()),)
    # The unit is a word of its own, and says its part.
    name = unit.strip()
    first, found, rest = said.partition(f" {name}")
    if not found:
        return ((said, match.start()),)
    return ((first, match.start()), (f" {name}{rest}", match.end() - len(name)))


def _is_after(match: re.Match[str], times: TimeTable) -> bool:
    before = match.string[max(0, match.start() - 20) : match.start()].split()
    return bool(before) and before[-1].lower() in times.after


def _fraction(match: re.Match[str], table: ReadingTable) -> Pieces:
    top, bottom = _VULGAR.get(match["sign"], (0, 0))
    words = table.fractions.get(f"{top}/{bottom}")
    if words is None:
        return None
    whole = (match["whole"] or "").strip()
    if whole in ("", "0"):
        return ((words, match.start()),)
    return ((f"{whole} {table.joint} {table.fractions.get(f'+{top}/{bottom}', words)}", match.start()),)


def _slashed(match: re.Match[str], table: ReadingTable) -> Pieces:
    words = table.fractions.get(match[2])
    if words is None:
        return None
    said = f"{match[1]}{table.joint} {table.fractions.get(f'+{match[2]}', words)}" if match[1] else words
    return ((said, match.start()),)


def _address(match: re.Match[str], table: ReadingTable) -> Pieces:
    """Read an address without its scheme."""
    address = re.sub(r"(?i)^https?://", "", match[0])
    words = [table.address.get("www", "www") if part.lower() == "www" else part for part in _parts(address)]
    return ((" ".join(table.address.get(word, word) for word in words), match.start()),)


def _parts(address: str) -> list[str]:
    """Return the words and signs of an address; digits of long numbers one by one."""
    parts = re.findall(r"[^\W\d_]+|\d+|[^\w\s]|_", address)
    return [" ".join(part) if part.isdigit() and len(part) > len("1234") else part for part in parts]
