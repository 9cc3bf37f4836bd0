"""Mandarin numbers before what they count, dates and times: 2 is liǎng before most measure words."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..readings import AS_DIGITS, Pieces, ReadingRule, ReadingTable, any_of
from .numbers import DIGITS, spelt, spoken

NUMBERS = AS_DIGITS
_LIANG = (
    "个個位只隻条條张張本件块塊元点點天年周週次种種部辆輛杯碗双雙对對家间"
    "間座棵朵片篇首句层層岁歲倍斤米公里千万萬亿億分秒人名"
)
_COUNTED = re.compile(rf"(?<![\d.,:/第-])2(?=[ \u00a0]?[{_LIANG}]|小时|小時|星期|公斤|公里|分钟|分鐘|个|百)")
_YEAR = re.compile(r"(?<!\d)(\d{4}|\d{2})(?=年(?!代|前|后|後|来|來|的时间|多))")
_DATE = re.compile(
    r"(?<![\d/.-])(?P<year>[12]\d{3})(?P<sign>[/.-])(?P<month>1[0-2]|0?[1-9])(?P=sign)"
    r"(?P<day>3[01]|[12]\d|0?[1-9])(?![\d/-])"
)
_TIME = re.compile(r"(?<![\d:])(?P<hour>[01]?\d|2[0-4])[:：](?P<minute>[0-5]\d)(?![\d:])")
_PERCENT = re.compile(r"(?<![\d.,-])(\d+(?:\.\d+)?)[%％]")
_FRACTION = re.compile(r"(?<![\d/.])(\d{1,3})/(\d{1,3})(?![\d/])")
_DEGREES = re.compile(r"(?<![\w.])(?P<minus>[-\u2212])?(?P<number>\d+(?:\.\d+)?) ?(?:°C|℃)")


_NUMBER = r"\d{1,3}(?:[, \u00a0\u2009\u202f]\d{3}){1,5}(?!\d)(?:\.\d{1,9})?|\d{1,16}(?:\.\d{1,9})?"
# Letters and digits, but not Chinese characters, may not stand before a number.
_NOT_AFTER = r"(?<![A-Za-z\d.,:/-])"
_MOBILE = re.compile(r"(?<![\d.,-])1[3-9]\d{9}(?![\d.,-])")
_RANGE = re.compile(rf"{_NOT_AFTER}(\d{{1,4}})[-~～\u2013](\d{{1,4}})(?![\w.,:/-]*\d)")
_BELOW = re.compile(rf"(?<![A-Za-z\d)）.,-])[-\u2212](?P<number>{_NUMBER})(?![\d:/-])")
_LONE = re.compile(rf"{_NOT_AFTER}(?P<number>{_NUMBER})(?![\d:/A-Za-z-]|[.,]\d)")


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of Mandarin."""
    yield ReadingRule(_DATE, _date)
    yield ReadingRule(_TIME, _time)
    yield ReadingRule(_YEAR, lambda match: [(spelt(match[0]), match.start())])
    yield ReadingRule(_COUNTED, lambda match: [("两", match.start())])
    yield ReadingRule(_PERCENT, lambda match: [(f"百分之{spoken(match[1])}", match.start())])
    yield ReadingRule(_FRACTION, lambda match: [(f"{match[2]}分之{match[1]}", match.start())])
    yield ReadingRule(_DEGREES, _degrees)
    yield ReadingRule(_MOBILE, lambda match: [(_dialled(match[0]), match.start())])
    money = re.compile(rf"(?P<sign>{any_of(table.money)})(?P<number>{_NUMBER})(?![\d])")
    yield ReadingRule(money, lambda match: _money(match, table))
    unit = re.compile(rf"{_NOT_AFTER}(?P<number>{_NUMBER}) ?(?P<unit>{any_of(table.measures)})(?![A-Za-z/])")
    yield ReadingRule(unit, lambda match: _unit(match, table))
    yield ReadingRule(_RANGE, lambda match: [(f"{_counted(match[1])}到{_counted(match[2])}", match.start())])
    yield ReadingRule(_BELOW, lambda match: [(f"负{spoken(match['number'])}", match.start())])
    yield ReadingRule(_LONE, _lone)


def _date(match: re.Match[str]) -> Pieces:
    words = f"{spelt(match['year'])}年{int(match['month'])}月{int(match['day'])}日"
    return [(words, match.start())]


def _time(match: re.Match[str]) -> Pieces:
    hour, minute = int(match["hour"]), int(match["minute"])
    said = "两点" if hour == 2 else f"{hour}点"
    if minute:
        said += f"零{minute}分" if minute < 10 else f"{minute}分"
    return [(said, match.start())]


def _degrees(match: re.Match[str]) -> Pieces:
    return [(f"{'零下' if match['minus'] else ''}{match['number']}度", match.start())]


def _counted(number: str) -> str:
    return "两" if number == "2" else spoken(number)


def _dialled(digits: str) -> str:
    """Return the digits of a telephone number, 1 as yāo."""
    return "".join("幺" if digit == "1" else DIGITS[int(digit)] for digit in digits)


def _money(match: re.Match[str], table: ReadingTable) -> Pieces:
    """Read yuan with jiao and fen, other money with decimals."""
    name = table.money[match["sign"]][0]
    whole, _, cents = match["number"].partition(".")
    if name != "元" or len(cents) != len("50"):
        return [(f"{_counted(match['number'])}{name}", match.start())]
    tenths, rest = cents[0], cents[1]
    words = f"{_counted(whole)}元" + (f"{tenths}角" if tenths != "0" else "零" if rest != "0" else "")
    return [(words + (f"{rest}分" if rest != "0" else ""), match.start())]


def _unit(match: re.Match[str], table: ReadingTable) -> Pieces:
    return [(f"{_counted(match['number'])}{table.measures[match['unit']][0]}", match.start())]


def _lone(match: re.Match[str]) -> Pieces:
    words = spoken(match["number"])
    return [(words, match.start())] if words != match["number"] else None
