"""English numbers of telephones, street addresses, and the numerals of kings and chapters."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from ..readings import Pieces, ReadingRule, ReadingTable, any_of
from .numbers import by_pairs, cardinal, ordinal, spelt, year

_PHONE = re.compile(
    r"(?<![\w.,/-])(?:(?:\+?\d{1,3}[ -])?\(\d{3}\) ?\d{3}[ -]\d{4}|(?:\+?\d[ -])?\d{3}[-.]\d{3}[-.]\d{4}"
    r"|\d{3}-\d{4}|\+\d{1,3}(?:[ -]\d{1,5}){2,6})(?![\w/-]|[.,]\d)"
)
_STATES = (
    "A[KLRZ]|C[AOT]|D[CE]|FL|GA|HI|I[ADLN]|K[SY]|LA|M[ADEINOST]|N[CDEHJMVY]|O[HKR]|PA|RI|S[CD]|T[NX]|UT|V[AT]"
    "|W[AIVY]"
)
_ZIP = re.compile(rf"(?<=\b(?:{_STATES}) )(?P<zip>\d{{5}})(?P<more>-\d{{4}})?(?!\w|[.,]\d)")
_ROMAN = re.compile(
    r"\b(?P<noun>[A-Z][a-z]+|WW) (?P<numeral>(?=[IVXL])(?:XL|L?X{0,3})(?:IX|IV|V?I{0,3}))(?![\w'\u2019])"
)
_VALUES = {"I": 1, "V": 5, "X": 10, "L": 50}


def phone_rules() -> Iterator[ReadingRule]:
    """Yield the rule for numbers of telephones, which look like other numbers."""
    yield ReadingRule(_PHONE, _phone)


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules for addresses and numerals."""
    streets, sides, rooms = (table.own[name] for name in ("streets", "sides", "rooms"))
    full = any_of({*streets, *streets.values(), "Way", "Lane"})
    house = re.compile(
        rf"(?<![\w.,/-])(?P<house>\d{{1,5}})(?P<letter>[A-D])? (?P<side>(?:{any_of(sides)})\.? )?"
        r"(?P<name>(?:\d{1,3}(?:st|nd|rd|th)|[A-Z][\w'\u2019]*)(?: [A-Z][\w'\u2019]*){0,2}?) "
        rf"(?P<street>{full})\b(?P<dot>\.?)"
    )
    room = re.compile(rf"\b(?P<kind>{any_of(rooms)})\.? (?P<sign>#?)(?=\d|[A-Z]\b)")
    counted, others = (frozenset(table.own["counted"][name].split()) for name in ("nouns", "others"))
    yield ReadingRule(house, lambda match: _house(match, streets, sides))
    yield ReadingRule(room, lambda match: [(f"{rooms[match['kind']]} ", match.start())])
    yield ReadingRule(_ZIP, _zip)
    yield ReadingRule(_ROMAN, lambda match: _roman(match, counted, others))


def _phone(match: re.Match[str]) -> Pieces:
    words = ", ".join(spelt(group) for group in re.findall(r"\d+", match[0]))
    return [(f"plus {words}" if match[0].startswith("+") else words, match.start())]


def _house(match: re.Match[str], streets: Mapping[str, str], sides: Mapping[str, str]) -> Pieces:
    number, after = match["house"], match.string[match.end() :].lstrip()[:1]
    digits = len(number)
    words = (
        by_pairs(number) if digits == len("123") else year(int(number)) if digits == len("1600") else number
    )
    words = spelt(number) if digits > len("1600") else words
    pieces = [(f"{words} {match['letter'] or ''}", match.start())]
    if match["side"]:
        pieces.append((f" {sides[match['side'].strip(' .')]}", match.start("side")))
    at = match.start("name")
    pieces += [(f" {part[0]}", at + part.start()) for part in re.finditer(r"\S+", match["name"])]
    ends = match["dot"] and (not after or after.isupper())
    street = streets.get(match["street"], match["street"])
    return [*pieces, (f" {street}" + ("." if ends else ""), match.start("street"))]


def _zip(match: re.Match[str]) -> Pieces:
    more = f", {spelt(match['more'][1:])}" if match["more"] else ""
    return [(spelt(match["zip"]) + more, match.start())]


def _roman(match: re.Match[str], counted: frozenset[str], others: frozenset[str]) -> Pieces:
    noun, numeral = match["noun"], match["numeral"]
    if noun in others or (len(numeral) == 1 and noun not in counted):
        return None
    words = cardinal(_value(numeral)) if noun in counted else f"the {ordinal(_value(numeral))}"
    return [(noun, match.start()), (f" {words}", match.start("numeral"))]


def _value(numeral: str) -> int:
    values = [_VALUES[letter] for letter in numeral]
    following = [*values[1:], 0]
    return sum(-value if value < after else value for value, after in zip(values, following, strict=True))
