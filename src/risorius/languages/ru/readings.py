"""Russian dates, years, centuries, ordinals, decimals and times of day, in the case that they need."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from ..amounts import Amounts, amount_rules, as_russian
from ..readings import NumberWords, Pieces, ReadingRule, ReadingTable, any_of
from ..roman import ROMAN, roman_value
from .numbers import cardinal, decimal, genitive, ordinal

_YEAR = re.compile(
    r"(?<![\w.,/-])(?P<year>1\d{3}|20\d\d)(?= (?P<word>годом|году|года|год|г\.)(?!\w))"
    r"|(?<![\w.,/-])(?P<year2>19\d\d|20\d\d)(?= г(?![\w.]))"
)
_SHORT = re.compile(r"(?<=\b(?:19|20)\d\d )г(?![\w.])|(?<=\d\d\d\d )г\.(?=(?P<rest>[^\w]{0,3}\w?))")
_CENTURY = re.compile(rf"(?<!\w)(?P<numeral>{ROMAN})(?= (?P<word>веком|веку|веке|века|век)(?!\w))")
_ENDING = re.compile(r"(?<![\w.,/-])(?P<number>\d{1,4})-(?P<ending>го|му|[йямехюм])(?!\w)")
_DECIMAL = re.compile(r"(?<![\w.,:/-])(?P<whole>\d{1,6}),(?P<decimals>\d{1,3})(?![\w/:-]|[.,]\d)")
_TIME = re.compile(r"(?<![\w:.,/-])(?P<hour>[01]?\d|2[0-4]):(?P<minute>[0-5]\d)(?![\w:/-]|[.,]\d)")
_FROM = re.compile(r"\b(?:со?|до|от|после|около|позже|раньше)$", re.IGNORECASE)
_IN = re.compile(r"\b(?:во?|о|об)$", re.IGNORECASE)
_TO = re.compile(r"\b(?:ко?|по)$", re.IGNORECASE)
_CASES = {"год": "ый", "век": "ый", "годом": "ым", "веком": "ым", "веке": "ом", "века": "ого", "года": "ого"}
_ENDINGS = {
    "го": "ого", "му": "ому", "й": "ый", "я": "ая", "м": "ом", "е": "ое", "х": "ых", "ю": "ую",
}  # fmt: skip


def _genitive(number: int) -> str:
    return ordinal(number, "ого") if 0 < number < 3000 else str(number)


NUMBERS = NumberWords(year=_genitive)


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of Russian."""
    months = any_of(table.dates.months)
    day = re.compile(
        rf"(?<![\w.,/-])(?P<day>3[01]|[12]?\d) (?P<month>{months})"
        r"(?: (?P<year>1\d{3}|20\d\d)(?![\w/-]|[.,]\d))?(?!\w)"
    )
    yield ReadingRule(day, lambda match: _day(match, table))
    yield ReadingRule(_YEAR, _year)
    yield ReadingRule(_SHORT, _short)
    yield ReadingRule(_CENTURY, _century)
    rulers = table.own["rulers"]
    ruler = re.compile(rf"\b(?P<name>{any_of(rulers)}) (?P<numeral>{ROMAN})(?!\w)")
    yield ReadingRule(ruler, lambda match: _ruler(match, rulers))
    yield ReadingRule(_ENDING, _ordinal)
    yield ReadingRule(_TIME, _time)
    yield from amount_rules(table, Amounts(place=as_russian, say=_say))
    yield ReadingRule(
        _DECIMAL, lambda match: [(decimal(int(match["whole"]), match["decimals"]), match.start())]
    )


def _before(match: re.Match[str]) -> str:
    return match.string[max(0, match.start() - 20) : match.start()].rstrip()


def _say(whole: str, decimals: str, name: str) -> str:
    if decimals and len(decimals) <= len("000") and len(whole) <= len("100000"):
        return decimal(int(whole), decimals)
    if decimals:
        return f"{whole},{decimals}"
    if name.startswith("копе"):
        return cardinal(int(whole), feminine=True)
    return whole


def _day(match: re.Match[str], table: ReadingTable) -> Pieces:
    number = int(match["day"])
    if number == 0:
        return None
    rest = [(f" {_genitive(int(match['year']))}", match.start("year"))] if match["year"] else []
    return [
        (table.dates.days[number - 1], match.start()),
        (f" {match['month']}", match.start("month")),
        *rest,
    ]


def _case(word: str, before: str) -> str:
    """Return the ending of an ordinal beside a form of "год" or "век"."""
    if word in ("году", "веку"):
        return "ом" if word == "году" and not _TO.search(before) else "ому"
    if word == "г.":
        return "ом" if _IN.search(before) else "ого"
    return _CASES[word]


def _year(match: re.Match[str]) -> Pieces:
    number, word = int(match["year"] or match["year2"]), match["word"] or "г."
    return [(ordinal(number, _case(word, _before(match))), match.start())]


def _short(match: re.Match[str]) -> Pieces:
    """Read "г." after a year; its full stop ends the sentence if a capital letter or nothing follows."""
    before = re.sub(r"\d{4} ?$", "", match.string[max(0, match.start() - 26) : match.start()]).rstrip()
    word = "году" if _IN.search(before) else "года"
    rest = match["rest"]
    ends = rest is not None and (not rest.strip() or rest[-1:].isupper())
    return [(f"{word}." if ends else word, match.start())]


def _century(match: re.Match[str]) -> Pieces:
    return [(ordinal(roman_value(match["numeral"]), _case(match["word"], _before(match))), match.start())]


def _ruler(match: re.Match[str], endings: Mapping[str, str]) -> Pieces:
    words = ordinal(roman_value(match["numeral"]), endings[match["name"]])
    return [(match["name"], match.start()), (f" {words}", match.start("numeral"))]


def _ordinal(match: re.Match[str]) -> Pieces:
    number, ending = int(match["number"]), _ENDINGS[match["ending"]]
    if not 0 < number < 3000:
        return None
    if match["ending"] == "е" and number % 10 == 0 and number >= 10:
        ending = "ые"
    return [(ordinal(number, ending), match.start())]


def _hour_genitive(hour: int) -> str:
    name = "часа" if hour % 20 == 1 else "часов"
    return name if hour == 1 else f"{genitive(hour)} {name}"


def _time(match: re.Match[str]) -> Pieces:
    hour, minute = int(match["hour"]), int(match["minute"])
    if minute:
        return [(f"{hour} {minute}" if minute >= 10 else f"{hour} ноль {minute}", match.start())]
    if _FROM.search(_before(match)):
        return [(_hour_genitive(hour), match.start())]
    name = ("час", "часа", "часов")[as_russian(hour, "")]
    return [(name if hour == 1 else f"{hour} {name}", match.start())]
