"""Polish dates, years, centuries and times of day in the case that the words around them ask for."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from ..amounts import Amounts, amount_rules, as_polish
from ..readings import NumberWords, Pieces, ReadingRule, ReadingTable, any_of
from ..roman import ROMAN, roman_value
from .numbers import ordinal, year

_YEAR = re.compile(r"(?<![\w.,/-])(?P<year>1\d{3}|20\d\d)(?= (?P<word>rokiem|roku|rok|r\.)(?!\w))")
_AFTER = re.compile(r"\b(?P<word>[Rr]okiem|[Rr]oku|[Rr]ok) (?P<year>1\d{3}|20\d\d)(?![\w/-]|[.,]\d)")
_SHORT = re.compile(r"(?<=\d\d\d\d )r\.(?=(?P<rest>[^\w]{0,3}\w?))")
_CENTURY = re.compile(
    rf"(?<!\w)(?P<numeral>{ROMAN})(?P<rest> (?P<word>wiekowi|wiekiem|wieku|wiek|w\.))(?!\w)"
)
_TIME = re.compile(
    r"(?<![\w:.,/-])(?P<hour>[01]?\d|2[0-4])(?P<sign>[:.])(?P<minute>[0-5]\d)(?![\w:/-]|[.,]\d)"
)
# After these an hour has the ending -ej; after the others -ą.
_OBLIQUE = re.compile(r"\b(?:o|od|do|po|około|koło|godzinie|godziny|godz\.)$", re.IGNORECASE)
_INSTRUMENTAL = re.compile(r"\b(?:przed|na|między(?: \d\d?:\d\d a)?)$", re.IGNORECASE)
_O_CLOCK = re.compile(r"\b(?:o|godzinie|godziny|godz\.)$", re.IGNORECASE)
_IN = re.compile(r"\b(?:we?|po|o)$", re.IGNORECASE)
_IS = re.compile(r"\b(?:jest|był|będzie)$", re.IGNORECASE)

NUMBERS = NumberWords(year=year)


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of Polish."""
    months = any_of(table.dates.months)
    day = re.compile(
        rf"(?<![\w.,/-])(?P<day>3[01]|[12]?\d) (?P<month>{months})"
        r"(?: (?P<year>1\d{3}|20\d\d)(?![\w/-]|[.,]\d))?(?!\w)"
    )
    yield ReadingRule(day, _day)
    yield ReadingRule(_YEAR, _year)
    yield ReadingRule(_AFTER, _after)
    yield ReadingRule(_SHORT, _short)
    yield ReadingRule(_CENTURY, _century)
    rulers, words = table.own["rulers"], table.own["before"]
    ruler = re.compile(rf"\b(?P<name>{any_of(rulers)}) (?P<numeral>{ROMAN})(?!\w)")
    yield ReadingRule(ruler, lambda match: _ruler(match, rulers))
    before = re.compile(rf"(?<!\w)(?P<numeral>{ROMAN})(?= (?P<word>{any_of(words)})(?!\w))")
    yield ReadingRule(before, lambda match: _numeral(match, words[match["word"]]))
    yield ReadingRule(_TIME, _time)
    yield from amount_rules(table, Amounts(place=as_polish))


def _before(match: re.Match[str]) -> str:
    return match.string[max(0, match.start() - 20) : match.start()].rstrip()


def _ending(word: str, before: str) -> str:
    """Return the ending of an ordinal beside a form of "rok" or "wiek"."""
    word = word.lower()
    if word in ("rok", "wiek"):
        return "y"
    if word.endswith("iem"):
        return "ym"
    if word.endswith("owi"):
        return "emu"
    return "ym" if _IN.search(before) else "ego"


def _day(match: re.Match[str]) -> Pieces:
    number = int(match["day"])
    if number == 0:
        return None
    ending = "y" if _IS.search(_before(match)) else "ego"
    rest = [(f" {year(int(match['year']))}", match.start("year"))] if match["year"] else []
    return [(ordinal(number, ending), match.start()), (f" {match['month']}", match.start("month")), *rest]


def _year(match: re.Match[str]) -> Pieces:
    return [(year(int(match["year"]), _ending(match["word"], _before(match))), match.start())]


def _after(match: re.Match[str]) -> Pieces:
    words = year(int(match["year"]), _ending(match["word"], _before(match)))
    return [(match["word"], match.start()), (f" {words}", match.start("year"))]


def _short(match: re.Match[str]) -> Pieces:
    """Read "r." after a year; its full stop ends the sentence if a capital letter or nothing follows."""
    rest = match["rest"]
    ends = not rest.strip() or rest[-1:].isupper()
    return [("roku." if ends else "roku", match.start())]


def _century(match: re.Match[str]) -> Pieces:
    word = "wieku" if match["word"] == "w." else match["word"]
    words = ordinal(roman_value(match["numeral"]), _ending(word, _before(match)))
    return [(words, match.start()), (f" {word}", match.start("word"))]


def _ruler(match: re.Match[str], endings: Mapping[str, str]) -> Pieces:
    words = ordinal(roman_value(match["numeral"]), endings[match["name"]])
    return [(match["name"], match.start()), (f" {words}", match.start("numeral"))]


def _numeral(match: re.Match[str], ending: str) -> Pieces:
    return [(ordinal(roman_value(match["numeral"]), ending), match.start())]


def _time(match: re.Match[str]) -> Pieces:
    before = _before(match)
    oblique, instrumental = _OBLIQUE.search(before), _INSTRUMENTAL.search(before)
    hour, minute = int(match["hour"]), int(match["minute"])
    if match["sign"] == "." and not _O_CLOCK.search(before):
        return None
    ending = "ej" if oblique else "ą" if instrumental else "a"
    words = ordinal(hour, ending) if hour else "zero"
    return [(f"{words} {minute}" if minute or not hour else words, match.start())]
