"""Vietnamese numbers that end in one, halves, ordinals and amounts."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..amounts import Amounts, amount_rules
from ..readings import NumberWords, Pieces, ReadingRule, ReadingTable, any_of
from ..roman import ROMAN, roman_value

# After the ordinal sign one is nhất and four is tư.
_ORDINAL = re.compile(r"\b(?P<word>[Tt]hứ) (?P<number>[14])(?![\w/-]|[.,]\d)")
_CENTURY = re.compile(rf"\b(?P<word>[Tt]hế kỷ|[Tt]hế kỉ) (?P<numeral>{ROMAN})(?!\w)")
_HALF = re.compile(r"(?<![\w.,])(?P<number>\d{1,6}) ?½ (?P<unit>\w{1,12})")
_NUMBER = re.compile(r"(?<![\w.,/:-])(?P<number>\d{1,3}(?:\.\d{3}){1,4}|\d{2,15})(?![\w/:-]|[.,]\d)")


def spoken(number: int) -> str:
    """Return a number as the voice is given it: 1 after twenty and more is mốt.

    >>> spoken(21), spoken(11), spoken(1031)
    ('20 mốt', '11', '1030 mốt')
    """
    return f"{number - 1} mốt" if number % 10 == 1 and number % 100 > 11 else str(number)


NUMBERS = NumberWords(year=spoken, minute=spoken, hour=spoken, day=lambda number, _before: spoken(number))


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of Vietnamese."""
    yield ReadingRule(_ORDINAL, _ordinal)
    yield ReadingRule(_CENTURY, _century)
    yield ReadingRule(_HALF, _half)
    yield from amount_rules(table, Amounts(place=lambda _whole, _decimals: 0, say=_say, before=True))
    signs = any_of(table.measures)
    yield ReadingRule(re.compile(rf"(?<=½) ?(?P<unit>{signs})(?!\w)"), lambda match: _unit(match, table))
    yield ReadingRule(_NUMBER, _number)


def _say(whole: str, decimals: str, _name: str) -> str:
    return f"{whole},{decimals}" if decimals else spoken(int(whole))


def _ordinal(match: re.Match[str]) -> Pieces:
    words = {"1": "nhất", "4": "tư"}[match["number"]]
    return [(match["word"], match.start()), (f" {words}", match.start("number"))]


def _century(match: re.Match[str]) -> Pieces:
    word = match["word"].split()
    second = match.start() + len(word[0]) + 1
    numeral = f" {spoken(roman_value(match['numeral']))}"
    return [(word[0], match.start()), (f" {word[1]}", second), (numeral, match.start("numeral"))]


def _half(match: re.Match[str]) -> Pieces:
    """Read half of a unit after the unit, which says it."""
    return [(match["number"], match.start()), (f" {match['unit']} rưỡi", match.start("unit"))]


def _unit(match: re.Match[str], table: ReadingTable) -> Pieces:
    return [(f" {table.measures[match['unit']][0]}", match.start("unit"))]


def _number(match: re.Match[str]) -> Pieces:
    number = int(match["number"].replace(".", ""))
    words = spoken(number)
    return [(words, match.start())] if words != str(number) else None
