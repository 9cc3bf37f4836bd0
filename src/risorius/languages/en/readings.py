"""English dates with names of months, years, decades, and times with a half of the day; and the rules of
`amounts.py` and `places.py`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..abbreviations import ReadText
from ..readings import NumberWords, Pieces, ReadingRule, ReadingTable
from . import amounts, places
from .numbers import cardinal, ordinal, year

_MONTHS = (
    "January|February|March|April|May|June|July|August|September|October|November|December"
    "|Jan|Feb|Mar|Apr|Jun|Jul|Aug|Sept|Sep|Oct|Nov|Dec"
)
_DAY = r"(?P<day>3[01]|[12]\d|0?[1-9])(?:st|nd|rd|th)?"
_YEAR = r"(?P<year>1[1-9]\d\d|20\d\d)"
_END = r"(?![\w$€£%]|[.,:/-]\d)"
_MONTH_DAY = re.compile(rf"\b(?P<month>{_MONTHS})\b\.? {_DAY}(?:,? {_YEAR})?{_END}")
_DAY_MONTH = re.compile(rf"(?<![\w.,:/-]){_DAY}(?P<of> of)? (?P<month>{_MONTHS})\b\.?(?:,? {_YEAR})?{_END}")
_LONE_YEAR = re.compile(rf"(?<=[A-Za-z]{{2}} ){_YEAR}{_END}")
_BEFORE_YEAR = re.compile(
    rf"\b(?:in|since|until|till|during|circa|year|summer|winter|spring|autumn|fall|{_MONTHS})$", re.IGNORECASE
)
_DECADE = re.compile(r"(?<![\w.,-])(?P<century>1[1-9]|20)(?P<decade>\d0)(?:s|'s|\u2019s)(?!\w)")
_TIME = re.compile(
    r"(?<![\w:.,/-])(?P<hour>0?[1-9]|1[0-2])(?:[:.](?P<minute>[0-5]\d)(?::(?P<second>[0-5]\d))?)?"
    r"(?P<gap>[ \u00a0]?)(?P<half>[ap]\.m\.|[AP]\.M\.|[ap]m\b|[AP]M\b)(?!\w)"
)


def minute(number: int) -> str:
    """Return the minutes of a time: "oh five", and "hundred" for none before seconds."""
    return f"oh {cardinal(number)}" if 0 < number < 10 else cardinal(number) if number else "hundred"


def _day(number: int, _before: str) -> str:
    return ordinal(number)


NUMBERS = NumberWords(year, minute, cardinal, _day)


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of English, the more special ones first."""
    months = {name[:3]: name for name in table.dates.months}

    def month_day(match: re.Match[str]) -> Pieces:
        month = months[match["month"][:3]]
        return [(month, match.start()), (f" {ordinal(int(match['day']))}", match.start("day")), *_year(match)]

    def day_month(match: re.Match[str]) -> Pieces:
        before = match.string[: match.start()].rstrip().lower()
        day = ("" if before.endswith("the") else "the ") + ordinal(int(match["day"]))
        of = [(" of", match.start("of") + 1)] if match["of"] else []
        month = (f"{'' if of else ' of'} {months[match['month'][:3]]}", match.start("month"))
        return [(day, match.start()), *of, month, *_year(match)]

    yield from places.phone_rules()
    yield ReadingRule(_MONTH_DAY, month_day)
    yield ReadingRule(_DAY_MONTH, day_month)
    yield ReadingRule(_LONE_YEAR, _lone_year)
    yield ReadingRule(_DECADE, _decade)
    yield ReadingRule(_TIME, _time)
    yield from places.rules(table)
    yield from amounts.rules(table)


def _year(match: re.Match[str]) -> list[ReadText]:
    return [(f", {year(int(match['year']))}", match.start("year"))] if match["year"] else []


def _lone_year(match: re.Match[str]) -> Pieces:
    before = match.string[max(0, match.start() - 20) : match.start()].rstrip()
    if _BEFORE_YEAR.search(before) is None:
        return None
    return [(year(int(match["year"])), match.start())]


def _decade(match: re.Match[str]) -> Pieces:
    century, decade = int(match["century"]), int(match["decade"])
    if decade == 0:
        words = "two thousands" if century == 20 else f"{cardinal(century)} hundreds"
    else:
        tens = cardinal(decade)
        words = f"{cardinal(century)} {f'{tens[:-1]}ies' if tens.endswith('y') else f'{tens}s'}"
    return [(words, match.start())]


def _time(match: re.Match[str]) -> Pieces:
    hour, minutes = cardinal(int(match["hour"])), int(match["minute"] or 0)
    words = f"{hour} {minute(minutes)}" if minutes else hour
    if match["second"]:
        seconds = int(match["second"])
        words = f"{hour} {minute(minutes)} and {cardinal(seconds)} second{'' if seconds == 1 else 's'}"
    half = match["half"]
    # A full stop that belongs to "p.m." ends the sentence too.
    rest = match.string[match.end() : match.end() + 3]
    ends = half.endswith(".") and (not rest.strip() or (rest[0].isspace() and rest.strip()[0].isupper()))
    said = f" {half[0].upper()} M" + ("." if ends else "")
    return [(words, match.start()), (said, match.start("half") if match["gap"] else match.start())]
