"""English money, units, fractions, ranges, ratios, powers and signs between numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..readings import Pieces, ReadingRule, ReadingTable, any_of
from .numbers import by_pairs, cardinal, ordinal, year

_NUMBER = r"(?:\d{1,3}(?:[, \u00a0\u2009\u202f]\d{3}){1,5}(?!\d)(?:\.\d{1,9})?|\d{1,15}(?:\.\d{1,9})?)"
_BLANK = re.compile("[ \u00a0\u2009\u202f]")
_VULGAR = "\u00bc-\u00be\u2150-\u215e"
_SIGNS = "$\u00a3\u20ac\u00a5"
_DASHES = " -\u2013"
_FRACTION = re.compile(
    r"(?<![\w./:-])(?P<whole>\d{1,4} )?(?P<top>\d{1,3})[/\u2044](?P<bottom>\d{1,3})(?![\w/-]|[.,]\d)"
)
_RATIO = re.compile(r"(?<![\w:.,/-])(?P<first>\d{1,4}):(?P<second>\d{1,4})(?![\w:/-]|[.,]\d)")
_RANGE = re.compile(r"(?<![\w.,/:-])(?P<first>\d{1,4})-(?P<second>\d{1,4})(?![\w/:-]|[.,]\d)")
_TIMES = re.compile(r"(?<=[apAP][mM])[-\u2013](?=\d)")
_HEIGHT = re.compile(
    r"(?<![\w.])(?P<feet>\d{1,2})['\u2019\u2032] ?(?P<inches>\d{1,2})(?:[\"\u201d\u2033]|'')(?!\w)"
)
_INCHES = re.compile(
    r"(?<=\d)(?:\u2033|\"(?= (?:wide|tall|long|high|deep|x|by|screen|monitor|TV|display)\b))"
)
_POWER = re.compile(
    r"(?<=[\w)])(?:\^(?P<written>-?\d{1,4})|(?P<raised>[\u00b2\u00b3\u2070\u00b9\u2074-\u2079\u207b]{1,4}))(?!\w)"
)
_RAISED = str.maketrans("\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079", "-0123456789")
_ABOUT = re.compile(rf"(?<![\w~])~ ?(?=[{_SIGNS}]?\d)")
_HASH = re.compile(r"(?<![\w#&])#(?=\d)")
_BY = re.compile(r"(?<=\d) ?(?P<sign>[x\u00d7]) ?(?=\d)")
_SIZE = re.compile(
    r"[\d.]{1,9}(?: ?[x\u00d7] ?[\d.]{1,9})? ?(?:[mck]?m|in|inch(?:es)?|ft|feet|foot|px|pixels)\b"
)
_COMPARED = re.compile(r"(?<=[\w)] )(?P<sign>[<>])(?= [\w(-])")
_WITH = re.compile(r"\bw/(?P<out>o\b)?(?=[ \w])")


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules for amounts."""
    yield ReadingRule(_HEIGHT, _height)
    yield from _money_rules(table)
    yield ReadingRule(_unit_pattern(table), lambda match: _unit(match, table))
    parted = re.compile(rf"(?:(?<=[{_VULGAR}])|(?<=/\d)) ?(?P<unit>{any_of(table.units)})(?!\w)")
    yield ReadingRule(parted, lambda match: _parted(match, table))
    yield ReadingRule(_INCHES, lambda match: [(" inches", match.start())])
    yield ReadingRule(_FRACTION, lambda match: _fraction(match, table))
    yield ReadingRule(_RATIO, _ratio)
    yield ReadingRule(_TIMES, lambda match: [(" to ", match.start())])
    yield ReadingRule(_RANGE, _range)
    yield ReadingRule(_POWER, _power)
    yield ReadingRule(_BY, _by)
    yield ReadingRule(_COMPARED, _compared)
    yield ReadingRule(_ABOUT, lambda match: [("about ", match.start())])
    yield ReadingRule(_HASH, lambda match: [("number ", match.start())])
    yield ReadingRule(_WITH, lambda match: [(" without " if match["out"] else " with ", match.start())])


def _money_rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules for money, but for a sign before an amount alone, which `abbreviations.toml` has."""
    lands = any_of(table.own["lands"])
    codes = any_of(code for code in table.currencies if code.isalpha())
    scales = r"[KMBT]|[kmb]n?|mm|tn"
    number = rf"(?P<number>{_NUMBER})"
    patterns = (
        rf"(?P<code>[{_SIGNS}]) ?(?P<number>\d{{1,3}}(?:[ \u00a0\u2009\u202f]\d{{3}})+)(?![\d/:-])",
        rf"(?P<code>[{_SIGNS}]) ?(?P<number>\d{{1,9}},\d\d)(?![\w,]|\.\d)",
        rf"(?<![\w.,{_SIGNS}])(?P<number>\d{{1,9}},\d\d)[ \u00a0]?(?P<code>[{_SIGNS}])(?!\w)",
        rf"(?P<code>[{_SIGNS}])(?P<from>{_NUMBER}) ?[-\u2013] ?(?P=code)?{number}(?P<scale>(?:{scales})\b)?"
        r"(?!\w)",
        rf"(?P<sign>[-\u2212])?(?P<land>\b(?:{lands}))?(?P<code>[{_SIGNS}]){number}(?P<scale>{scales})\b",
        rf"(?<![\w.,])(?P<sign>[-\u2212])(?P<code>[{_SIGNS}]){number}(?!\w)",
        rf"\b(?P<land>{lands})(?P<code>\$){number}(?!\w)",
        rf"(?<![\w.,{_SIGNS}]){number}[ \u00a0]?(?P<code>[{_SIGNS}\u20b9\u00a2])(?![\w])",
        rf"\b(?P<code>{codes})[ \u00a0]?{number}(?!\w)",
        rf"(?<![\w.,]){number}[ \u00a0](?P<code>{codes})\b",
    )
    for pattern in patterns:
        yield ReadingRule(re.compile(pattern), lambda match: _money(match, table))


def _money(match: re.Match[str], table: ReadingTable) -> Pieces:
    groups = match.groupdict()
    number, code = _BLANK.sub(",", match["number"]), match["code"]
    number = re.sub(r"^(\d+),(\d\d)$", r"\1.\2", number)
    one, several, hundredth, hundredths = table.currencies[code]
    if groups.get("from"):
        scale = f" {table.scales[groups['scale'].lower()]}" if groups["scale"] else ""
        return [(f"{match['from']} to {number}{scale} {several}", match.start())]
    land = f"{table.own['lands'][groups['land']]} " if groups.get("land") else ""
    whole, _, cents = number.replace(",", "").partition(".")
    if groups.get("scale"):
        first, name = f"{number} {table.scales[groups['scale'].lower()]}", f"{land}{several}"
    elif len(cents) != len("50") or not hundredth:
        first, name = number, land + (one if number == "1" else several)
    else:
        first, name = _with_cents(int(whole), int(cents), (one, several, hundredth, hundredths)), ""
    first = f"minus {first}" if groups.get("sign") else first
    if name and match.start("code") > match.end("number"):
        return [(first, match.start()), (f" {name}", match.start("code"))]
    return [(f"{first} {name}".rstrip(), match.start())]


def _with_cents(whole: int, cents: int, names: tuple[str, str, str, str]) -> str:
    one, several, hundredth, hundredths = names
    parts = [f"{whole} {one if whole == 1 else several}"] if whole or not cents else []
    parts += [f"{cents} {hundredth if cents == 1 else hundredths}"] if cents else []
    return " and ".join(parts)


def _unit_pattern(table: ReadingTable) -> re.Pattern[str]:
    return re.compile(
        rf"(?<![\w.,{_SIGNS}/:-])(?P<sign>[-\u2212])?(?P<from>{_NUMBER} ?[-\u2013] ?)?"
        rf"(?P<number>{_NUMBER})(?P<gap>[ \u00a0-]?)"
        rf"(?P<unit>{any_of(table.units)})(?:/(?P<per>{any_of(table.units)}))?(?![\w\u00b2\u00b3/\u00b0])"
    )


def _unit(match: re.Match[str], table: ReadingTable) -> Pieces:
    number, sign = _BLANK.sub(",", match["number"]), "minus " if match["sign"] else ""
    name = table.units[match["unit"]][0 if number == "1" or match["gap"] == "-" else 1]
    if match["from"]:
        number = f"{match['from'].rstrip(_DASHES)} to {number}"
    if match["per"]:
        name = f"{name} per {table.units[match['per']][0]}"
    if not match["gap"]:
        return [(f"{sign}{number} {name}", match.start())]
    return [(f"{sign}{number}", match.start()), (f" {name}", match.start("unit"))]


def _parted(match: re.Match[str], table: ReadingTable) -> Pieces:
    """Read the unit after a fraction: of one, unless a whole number stands before the fraction."""
    before = match.string[: match.start() - 1].rstrip()[-1:]
    return [(f" {table.units[match['unit']][before.isdigit()]} ", match.start("unit"))]


def _fraction(match: re.Match[str], table: ReadingTable) -> Pieces:
    top, bottom = int(match["top"]), int(match["bottom"])
    if bottom == 0:
        return None
    if match[0] == "24/7":
        return [("twenty four seven", match.start())]
    words = table.fractions.get(f"{top}/{bottom}")
    if words is None and bottom in (5, 10, 100) and top <= bottom:
        words = f"{cardinal(top)} out of {cardinal(bottom)}"
    elif words is None and top < bottom and bottom in (3, 4, *range(6, 10), 16, 32, 64):
        words = f"{cardinal(top)} {ordinal(bottom)}{'' if top == 1 else 's'}"
    if words is not None and match["whole"]:
        return [(f"{match['whole']}and {words}", match.start())]
    if words is None:
        words = f"{by_pairs(match['top'])} over {by_pairs(match['bottom'])}"
        words = f"{match['whole'] or ''}{words}"
    return [(words, match.start())]


def _ratio(match: re.Match[str]) -> Pieces:
    """Read what is not a time of day: "3:2" and "16:9"."""
    if len(match["second"]) == len("00") and int(match["first"]) <= 24 and int(match["second"]) < 60:
        return None
    return [(f"{match['first']} to {match['second']}", match.start())]


def _range(match: re.Match[str]) -> Pieces:
    first, second = match["first"], match["second"]
    if len(first) == len("2020") and len(second) in (2, 4) and first.startswith(("1", "20")):
        last = year(int(second)) if len(second) == len("2021") else by_pairs(second)
        return [(f"{year(int(first))} to {last}", match.start())]
    return [(f"{first} to {second}", match.start())]


def _height(match: re.Match[str]) -> Pieces:
    feet, inches = int(match["feet"]), int(match["inches"])
    foot, inch = "foot" if feet == 1 else "feet", "inch" if inches == 1 else "inches"
    return [(f"{cardinal(feet)} {foot} {cardinal(inches)} {inch}", match.start())]


def _power(match: re.Match[str]) -> Pieces:
    power = match["written"] or match["raised"].translate(_RAISED)
    words = {"2": "squared", "3": "cubed"}.get(power)
    if words is None:
        sign = "minus " if power.startswith("-") else ""
        words = f"to the power of {sign}{cardinal(int(power.lstrip('-')))}"
    return [(f" {words}", match.start())]


def _by(match: re.Match[str]) -> Pieces:
    is_size = match["sign"] == "x" or _SIZE.match(match.string, match.end()) is not None
    return [(" by " if is_size else " times ", match.start("sign"))]


def _compared(match: re.Match[str]) -> Pieces:
    return [(" less than " if match["sign"] == "<" else " greater than ", match.start())]
