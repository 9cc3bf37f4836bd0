"""Money and units in languages with names for one, few and many."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from .readings import Pieces, ReadingRule, ReadingTable, any_of

_BLANKS = " \u00a0\u2009\u202f"
_COMMA = (
    rf"(?:\d{{1,3}}(?:[.{_BLANKS}]\d{{3}}){{1,5}}(?!\d)(?:,\d{{1,9}})?|\d{{1,15}}(?:,\d{{1,9}})?)"
    r"(?!\d|[.,]\d)"
)
_POINT = r"(?:\d{1,3}(?:,\d{2,3}){1,5}(?!\d)(?:\.\d{1,9})?|\d{1,15}(?:\.\d{1,9})?)(?![\d]|[.,]\d)"


def one_or_more(whole: int, decimals: str) -> int:
    """Return the place of a name: 0 for one, 1 for several."""
    return 0 if whole == 1 and not decimals else 1


def as_polish(whole: int, decimals: str) -> int:
    """Return the place of a name by CLDR's plural rules of Polish: one, few, many, other."""
    if decimals:
        return 3
    if whole == 1:
        return 0
    return 1 if whole % 10 in (2, 3, 4) and whole % 100 not in (12, 13, 14) else 2


def as_russian(whole: int, decimals: str) -> int:
    """Return the place of a name by CLDR's plural rules of Russian: one, few, many, other."""
    if decimals:
        return 3
    if whole % 10 == 1 and whole % 100 != 11:
        return 0
    return 1 if whole % 10 in (2, 3, 4) and whole % 100 not in (12, 13, 14) else 2


def as_written(whole: str, decimals: str, _name: str) -> str:
    """Return a number with a decimal comma in digits, as the voice reads it."""
    return f"{whole},{decimals}" if decimals else whole


class Amounts(NamedTuple):
    """How a language says amounts.

    `place`: that of a name in its list, for a whole number and its decimals. `say`: a number by its whole
    part, its decimals and the name after it. `point`: whether a point stands before the decimals. `before`:
    whether money is read as decimals, its name after them.
    """

    place: Callable[[int, str], int] = one_or_more
    say: Callable[[str, str, str], str] = as_written
    point: bool = False
    before: bool = False


def amount_rules(table: ReadingTable, amounts: Amounts) -> Iterator[ReadingRule]:
    """Yield the rules for the money and the units of a table."""
    number = rf"(?P<number>{_POINT if amounts.point else _COMMA})"
    minus = "(?P<minus>[-\u2212])?"
    if table.money:
        signs = any_of(table.money)
        first = rf"(?<![\w.,-]){minus}(?P<name>{signs})[ \u00a0]?{number}(?!\w)"
        last = rf"(?<![\w.,:/-]){minus}{number}(?P<gap>[ \u00a0]?)(?P<name>{signs})(?!\w)"
        for pattern in (first, last):
            yield ReadingRule(re.compile(pattern), lambda match: _money(match, table, amounts))
    if table.measures:
        names = any_of(table.measures)
        unit = (
            rf"(?<![\w.,:/-]){minus}{number}(?P<gap>[ \u00a0]?)(?P<name>{names})(?![\w\u00b2\u00b3/\u00b0])"
        )
        yield ReadingRule(re.compile(unit), lambda match: _measure(match, table, amounts))


def _parts(match: re.Match[str], amounts: Amounts) -> tuple[str, str]:
    """Return the digits before and after the decimal sign."""
    whole, _, decimals = match["number"].partition("." if amounts.point else ",")
    return re.sub(r"\D", "", whole), decimals


def _named(names: Sequence[str], place: int) -> str:
    return names[min(place, len(names) - 1)]


def _money(match: re.Match[str], table: ReadingTable, amounts: Amounts) -> Pieces:
    whole, decimals = _parts(match, amounts)
    names, words = table.money[match["name"]], table.own.get("money", {})
    cents = table.cents.get(match["name"], ())
    split = len(decimals) == len("50") and not amounts.before and bool(cents)
    if split or not decimals.strip("0"):
        name = _named(names, amounts.place(int(whole), ""))
        first = words.get("one", whole) if whole == "1" else amounts.say(whole, "", name)
        if split and int(decimals):
            cent = _named(cents, amounts.place(int(decimals), ""))
            joint = f" {words['joint']}" if words.get("joint") else ""
            name += f"{joint} {amounts.say(str(int(decimals)), '', cent)} {cent}".rstrip()
    else:
        name = _named(names, amounts.place(int(whole), decimals))
        first = amounts.say(whole, decimals, name)
    return _pieces(match, table, first, name)


def _measure(match: re.Match[str], table: ReadingTable, amounts: Amounts) -> Pieces:
    whole, decimals = _parts(match, amounts)
    name = _named(table.measures[match["name"]], amounts.place(int(whole), decimals))
    return _pieces(match, table, amounts.say(whole, decimals, name), name)


def _pieces(match: re.Match[str], table: ReadingTable, first: str, name: str) -> Pieces:
    """Return the number and the name; two words if a blank stands between them."""
    if match["minus"]:
        first = f"{table.minus or table.between.get(chr(0x2212), '')} {first}"
    if match["name"].endswith("."):
        rest = match.string[match.end() : match.end() + 2]
        name += "." if not rest.strip() or rest[-1:].isupper() else ""
    if match.groupdict().get("gap"):
        return [(first, match.start()), (f" {name}", match.start("name"))]
    return [(f"{first} {name}", match.start())]
