"""Dutch ordinals, rulers and amounts."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..amounts import Amounts, amount_rules
from ..readings import AS_DIGITS, Pieces, ReadingRule, ReadingTable, any_of
from ..roman import ROMAN, roman_value

NUMBERS = AS_DIGITS
_SMALL = (
    "nul", "een", "twee", "drie", "vier", "vijf", "zes", "zeven", "acht", "negen", "tien", "elf", "twaalf",
    "dertien", "veertien", "vijftien", "zestien", "zeventien", "achttien", "negentien",
)  # fmt: skip
_TENS = ("twintig", "dertig", "veertig", "vijftig", "zestig", "zeventig", "tachtig", "negentig")
_ORDINAL = re.compile(r"(?<![\w.,/-])(?P<number>\d{1,3})(?:ste|de|e)(?!-?\w)")
_HALVES = re.compile(r"(?<![\w.,/-])1 ?½")
_NUMBERED = re.compile(r"(?<=[a-zë] )(?P<numeral>(?=[IVX]{2})X{0,3}(?:IX|IV|V?I{0,3}))(?!\w)(?!\.\w)")


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of Dutch."""
    yield ReadingRule(_ORDINAL, _ordinal)
    names = any_of(table.own["rulers"])
    ruler = re.compile(rf"\b(?P<name>{names}) (?P<numeral>{ROMAN})(?!\w)(?!\.\w)")
    yield ReadingRule(ruler, _ruler)
    yield ReadingRule(_NUMBERED, lambda match: [(str(roman_value(match[0])), match.start())])
    yield ReadingRule(_HALVES, lambda match: [("anderhalf", match.start())])
    yield from amount_rules(table, Amounts())


def cardinal(number: int) -> str:
    """Return a whole number below 1000.

    >>> cardinal(21), cardinal(32), cardinal(135)
    ('eenentwintig', 'tweeëndertig', 'honderdvijfendertig')
    """
    if number < 20:
        return _SMALL[number]
    if number < 100:
        tens, ones = divmod(number, 10)
        joint = "ën" if _SMALL[ones].endswith("e") else "en"
        return (f"{_SMALL[ones]}{joint}" if ones else "") + _TENS[tens - 2]
    hundreds, rest = divmod(number, 100)
    head = "honderd" if hundreds == 1 else f"{_SMALL[hundreds]}honderd"
    return head + (cardinal(rest) if rest else "")


def ordinal(number: int) -> str:
    """Return a whole number below 1000 as an ordinal.

    >>> ordinal(1), ordinal(3), ordinal(8), ordinal(12), ordinal(21), ordinal(103)
    ('eerste', 'derde', 'achtste', 'twaalfde', 'eenentwintigste', 'honderdderde')
    """
    words, last = cardinal(number), number % 100
    if last in (1, 3):
        return words.removesuffix(_SMALL[last]) + {1: "eerste", 3: "derde"}[last]
    return words + ("ste" if last in (0, 8) or last >= 20 else "de")


def _ordinal(match: re.Match[str]) -> Pieces:
    number = int(match["number"])
    return [(ordinal(number), match.start())] if number else None


def _ruler(match: re.Match[str]) -> Pieces:
    words = f" de {ordinal(roman_value(match['numeral']))}"
    return [(match["name"], match.start()), (words, match.start("numeral"))]
