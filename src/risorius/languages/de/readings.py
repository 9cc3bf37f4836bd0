"""German dates, ordinals with the ending of their case, years, money and numbers of telephones."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..readings import NumberWords, Pieces, ReadingRule, ReadingTable
from .numbers import cardinal, ordinal, year

# After these a number has the ending -en or -e, after none -er.
_EN = re.compile(
    r"\b(?:am|vom|zum|beim|bis|dem|den|des|im|ab|seit|nach|vor|zur|der|jedem|jeden|diesem|diesen|einem)"
    r"(?: (?:Mon|Diens|Mitt|Donners|Frei|Sams|Sonn)(?:tag|woch|abend|s)?,?(?: de[mn])?)? ?$",
    re.IGNORECASE,
)
_E = re.compile(r"\b(?:der|die|das|dieser|diese|dieses|jeder|jede|jedes)(?: \w+tag,?)? ?$", re.IGNORECASE)
_ALWAYS_EN = re.compile(r"\b(?:de[mn]|des|zum|zur|vom|am|im|beim)(?: \w+,?(?: de[mn])?)? ?$", re.IGNORECASE)
_MONTH = "Januar|Jänner|Februar|März|April|Mai|Juni|Juli|August|September|Oktober|November|Dezember"
_SHORT = r"(?:Jan|Feb|Mrz|Apr|Jun|Jul|Aug|Sept|Sep|Okt|Nov|Dez)\b\.?"
_DAY_MONTH = re.compile(
    rf"(?<![\w.,/-])(?:(?P<first>[0-3]?\d)\. ?(?P<joint>-|\u2013|bis|und) ?)?"
    rf"(?P<day>[0-3]?\d)\. ?(?P<month>{_MONTH}|{_SHORT})"
    r"(?: (?P<year>1[1-9]\d\d|20\d\d)(?![\w,]*\d))?(?!\w)"
)
_SHORT_DATE = re.compile(r"(?<![\w.,/-])(?P<day>[0-3]?\d)\.(?P<month>1[0-2]|0?[1-9])\.(?![\w/-])")
_ORDINAL = re.compile(
    r"\b(?P<before>(?i:am|der|die|das|den|dem|des|zum|zur|im|vom|beim|jeder|jede|jedes|jeden|dieser|diese|dieses))"
    r" (?P<number>\d{1,3})\.(?= ?[A-ZÄÖÜ][a-zäöüß])"
)
_KING = re.compile(
    r"\b(?P<name>[A-ZÄÖÜ][a-zäöüß]{2,}) (?P<numeral>(?=[IVXL])(?:XL|L?X{0,3})(?:IX|IV|V?I{0,3}))\."
    r"(?=[\s,;:!?)]|$)"
)
_YEAR = re.compile(
    r"(?<=[a-zäöü] )(?P<year>1[1-9]\d\d)(?![\w%€$]|[.,:/-]\d| ?(?:€|Euro|Meter|Kilo|Gramm|km|kg|m)\b)"
)
_BEFORE_YEAR = re.compile(
    rf"\b(?:Jahre?n?|Jahres|seit|ab|bis|von|Sommer|Winter|Frühjahr|Frühling|Herbst|Anfang|Mitte|Ende|{_MONTH})$"
)
_MONEY = re.compile(
    r"(?:(?P<sign>[€$£]) ?(?P<number>\d{1,3}(?:\.\d{3})*(?:,\d\d)?|\d{1,12}(?:,\d\d)?)"
    r"|(?<![\w.,])(?P<number2>\d{1,3}(?:\.\d{3})*,\d\d|\d{1,12},\d\d)[ \u00a0]?"
    r"(?P<sign2>€|\$|£|EUR\b|Euro\b))(?![\w]|,\d)"
)
_NAMES = {"€": "Euro", "EUR": "Euro", "Euro": "Euro", "$": "Dollar", "£": "Pfund"}
_PHONE = re.compile(
    r"(?<![\w.,/-])(?:\+\d{1,3} ?(?:\(0\) ?)?|0)\d{2,5}(?:[ /-]\d{2,8}){1,5}(?![\w/-]|[.,]\d)"
)
_HOURS = re.compile(r"(?<![\w.,:/-])(?P<first>\d{1,2})[-\u2013](?P<last>\d{1,2})(?= Uhr\b)")
_VALUES = {"I": 1, "V": 5, "X": 10, "L": 50}


def _day(number: int, before: str) -> str:
    return ordinal(number, _ending(before))


def _ending(before: str) -> str:
    """Return the ending of an ordinal by the words before it."""
    if _ALWAYS_EN.search(before):
        return "en"
    return "e" if _E.search(before) else "en" if _EN.search(before) else "er"


NUMBERS = NumberWords(year=year, day=_day)


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of German, the more special ones first."""
    months = {name[:3]: name for name in table.dates.months} | {"Jän": "Jänner", "Mrz": "März"}

    def day_month(match: re.Match[str]) -> Pieces:
        ending = _ending(match.string[max(0, match.start() - 20) : match.start()])
        first = []
        if match["first"]:
            joint = "und" if match["joint"] == "und" else "bis"
            first = [(f"{ordinal(int(match['first']), ending)} {joint} ", match.start())]
        month = match["month"] if match["month"] in (*months.values(),) else months[match["month"][:3]]
        rest = [(f" {year(int(match['year']))}", match.start("year"))] if match["year"] else []
        day = (ordinal(int(match["day"]), ending), match.start("day"))
        return [*first, day, (f" {month}", match.start("month")), *rest]

    def short_date(match: re.Match[str]) -> Pieces:
        day = int(match["day"])
        if not 1 <= day <= 31:
            return None
        ending = _ending(match.string[max(0, match.start() - 20) : match.start()])
        month = table.dates.months[int(match["month"]) - 1]
        # A full stop may end the sentence, too.
        rest = match.string[match.end() : match.end() + 40]
        ends = not rest.strip() or (rest[0] == " " and rest.lstrip()[0].isupper() and "\n" in rest[:2])
        return [(f"{ordinal(day, ending)} {month}" + ("." if ends else ""), match.start())]

    yield ReadingRule(_PHONE, _phone)
    yield ReadingRule(_DAY_MONTH, day_month)
    yield ReadingRule(_SHORT_DATE, short_date)
    yield ReadingRule(_ORDINAL, _ordinal)
    yield ReadingRule(_KING, _king)
    yield ReadingRule(_HOURS, lambda match: [(f"{match['first']} bis {match['last']}", match.start())])
    yield ReadingRule(_MONEY, _money)
    yield ReadingRule(_YEAR, _lone_year)


def _ordinal(match: re.Match[str]) -> Pieces:
    words = ordinal(int(match["number"]), _ending(f"{match['before']} "))
    return [(match["before"], match.start()), (f" {words}", match.start("number"))]


def _king(match: re.Match[str]) -> Pieces:
    values = [_VALUES[letter] for letter in match["numeral"]]
    following = [*values[1:], 0]
    number = sum(-v if v < after else v for v, after in zip(values, following, strict=True))
    return [(match["name"], match.start()), (f" der {ordinal(number)}", match.start("numeral"))]


def _lone_year(match: re.Match[str]) -> Pieces:
    before = match.string[max(0, match.start() - 20) : match.start()].rstrip()
    if _BEFORE_YEAR.search(before) is None:
        return None
    return [(year(int(match["year"])), match.start())]


def _money(match: re.Match[str]) -> Pieces:
    number, sign = match["number"] or match["number2"], match["sign"] or match["sign2"]
    whole, _, cents = number.partition(",")
    euros = cardinal(1)[:-1] if whole == "1" else whole
    words = f"{euros} {_NAMES[sign]}" + (f" {int(cents)}" if cents and int(cents) else "")
    if match["sign2"] and match.start("sign2") > match.end("number2"):
        # The currency is a word of its own, with the cents after it.
        first, name, rest = words.partition(f" {_NAMES[sign]}")
        return [(first, match.start()), (name + rest, match.start("sign2"))]
    return [(words, match.start())]


def _phone(match: re.Match[str]) -> Pieces:
    groups = [" ".join(cardinal(int(digit)) for digit in group) for group in re.findall(r"\d+", match[0])]
    words = ", ".join(groups)
    return [(f"plus {words}" if match[0].startswith("+") else words, match.start())]
