"""Mandarin numbers before what they count, dates and times: 2 is liǎng before most measure words."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..readings import AS_DIGITS, Pieces, ReadingRule, ReadingTable

NUMBERS = AS_DIGITS
_DIGITS = "零一二三四五六七八九"
_LIANG = (
    "个個位只隻条條张張本件块塊元点點天年周週次种種部辆輛杯碗双雙对對家间"
    "間座棵朵片篇首句层層岁歲倍斤米公里千万萬亿億分秒人名"
)
_COUNTED = re.compile(rf"(?<![\d.,:/-])2(?=[ \u00a0]?[{_LIANG}]|小时|小時|星期|公斤|公里|分钟|分鐘|个|百)")
_YEAR = re.compile(r"(?<!\d)(\d{4}|\d{2})(?=年(?!前|后|後|来|來|的时间|多))")
_DATE = re.compile(
    r"(?<![\d/.-])(?P<year>[12]\d{3})(?P<sign>[/.-])(?P<month>1[0-2]|0?[1-9])(?P=sign)"
    r"(?P<day>3[01]|[12]\d|0?[1-9])(?![\d/-])"
)
_TIME = re.compile(r"(?<![\d:])(?P<hour>[01]?\d|2[0-4])[:：](?P<minute>[0-5]\d)(?![\d:])")
_PERCENT = re.compile(r"(?<![\d.,-])(\d+(?:\.\d+)?)[%％]")
_FRACTION = re.compile(r"(?<![\d/.])(\d{1,3})/(\d{1,3})(?![\d/])")
_DEGREES = re.compile(r"(?<![\w.])(?P<minus>[-\u2212])?(?P<number>\d+(?:\.\d+)?) ?(?:°C|℃)")


def rules(_table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of Mandarin."""
    yield ReadingRule(_DATE, _date)
    yield ReadingRule(_TIME, _time)
    yield ReadingRule(_YEAR, lambda match: [(_spelt(match[0]), match.start())])
    yield ReadingRule(_COUNTED, lambda match: [("两", match.start())])
    yield ReadingRule(_PERCENT, lambda match: [(f"百分之{match[1]}", match.start())])
    yield ReadingRule(_FRACTION, lambda match: [(f"{match[2]}分之{match[1]}", match.start())])
    yield ReadingRule(_DEGREES, _degrees)


def _spelt(digits: str) -> str:
    return "".join(_DIGITS[int(digit)] for digit in digits)


def _date(match: re.Match[str]) -> Pieces:
    words = f"{_spelt(match['year'])}年{int(match['month'])}月{int(match['day'])}日"
    return [(words, match.start())]


def _time(match: re.Match[str]) -> Pieces:
    hour, minute = int(match["hour"]), int(match["minute"])
    said = "两点" if hour == 2 else f"{hour}点"
    if minute:
        said += f"零{minute}分" if minute < 10 else f"{minute}分"
    return [(said, match.start())]


def _degrees(match: re.Match[str]) -> Pieces:
    return [(f"{'零下' if match['minus'] else ''}{match['number']}度", match.start())]
