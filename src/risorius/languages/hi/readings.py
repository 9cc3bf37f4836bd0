"""Hindi quarters and halves, in numbers and times of day, and amounts."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..amounts import Amounts, amount_rules
from ..readings import AS_DIGITS, Pieces, ReadingRule, ReadingTable

NUMBERS = AS_DIGITS
_MIXED = re.compile(r"(?<![\d.,/])(?P<number>\d{1,6}) ?(?P<sign>[¼½¾])")
_TIME = re.compile(
    r"(?<![\w:.,/-])(?P<hour>[01]?\d|2[0-4]):(?P<minute>15|30|45)(?P<unit> ?बजे)?(?![\w:/-]|[.,]\d)"
)
_QUARTERS = {"¼": 1, "½": 2, "¾": 3, "15": 1, "30": 2, "45": 3}


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of Hindi."""
    yield ReadingRule(_MIXED, _mixed)
    yield ReadingRule(_TIME, _time)
    yield from amount_rules(table, Amounts(say=_say, point=True))


def with_quarters(number: int, quarters: int) -> str:
    """Return a number and one to three quarters.

    >>> with_quarters(1, 2), with_quarters(2, 2), with_quarters(5, 2), with_quarters(4, 3)
    ('डेढ़', 'ढाई', 'साढ़े 5', 'पौने 5')
    """
    if quarters == 2 and number in (1, 2):
        return "डेढ़" if number == 1 else "ढाई"
    if quarters == 3:
        return f"पौने {number + 1}"
    if quarters == 1:
        return "सवा" if number == 1 else f"सवा {number}"
    return f"साढ़े {number}"


def _say(whole: str, decimals: str, _name: str) -> str:
    return f"{whole}.{decimals}" if decimals else whole


def _mixed(match: re.Match[str]) -> Pieces:
    number = int(match["number"])
    return [(with_quarters(number, _QUARTERS[match["sign"]]), match.start())] if number else None


def _time(match: re.Match[str]) -> Pieces:
    """Read quarters of an hour; after twelve the minutes are read."""
    hour = int(match["hour"])
    if not 1 <= hour <= 12 or (hour == 12 and match["minute"] == "45"):
        return None
    words = with_quarters(hour, _QUARTERS[match["minute"]])
    if match["unit"]:
        name = match["unit"].strip()
        return [(words, match.start()), (f" {name}", match.end() - len(name))]
    return [(f"{words} बजे", match.start())]
