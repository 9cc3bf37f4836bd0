"""English readings of a whole number: as a quantity, with or without "and", as a year, by digits."""

from __future__ import annotations

import re

_SMALL = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
]
_TENS = ["twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"]
_SCALES = ((10**9, "billion"), (10**6, "million"), (1000, "thousand"))
_NUMBER = re.compile(r"\d{1,3}(?:,\d{3})+|\d{1,12}")
LARGEST = 10**12
_YEARS = range(1100, 2100)


def number_readings(text: str) -> tuple[str, ...]:
    """Return how a whole number may be read, in words; nothing if it is not a number.

    >>> number_readings("105")
    ('one hundred five', 'one hundred and five', 'one oh five', 'one zero five')
    """
    if not text.isascii() or _NUMBER.fullmatch(text) is None:
        return ()
    digits = text.replace(",", "")
    number = int(digits)
    found = [_cardinal(number, ""), _cardinal(number, "and ")] if digits == str(number) else []
    if number in _YEARS and len(digits) == 4 and number % 1000 >= 10:
        found.append(_year(number))
    if len(digits) > 1:
        found += [_digits(digits, "oh"), _digits(digits, "zero")]
    return tuple(dict.fromkeys(found))


def _cardinal(number: int, joint: str) -> str:
    if number < 20:
        return _SMALL[number]
    if number < 100:
        tens, ones = divmod(number, 10)
        return _TENS[tens - 2] + (f" {_SMALL[ones]}" if ones else "")
    if number < 1000:
        hundreds, rest = divmod(number, 100)
        return f"{_SMALL[hundreds]} hundred" + (f" {joint}{_cardinal(rest, joint)}" if rest else "")
    scale, name = next(entry for entry in _SCALES if number >= entry[0])
    count, rest = divmod(number, scale)
    links = joint if 0 < rest < 100 else ""
    return f"{_cardinal(count, joint)} {name}" + (f" {links}{_cardinal(rest, joint)}" if rest else "")


def _year(number: int) -> str:
    century, rest = divmod(number, 100)
    if rest == 0:
        return f"{_cardinal(century, '')} hundred"
    return f"{_cardinal(century, '')} {f'oh {_SMALL[rest]}' if rest < 10 else _cardinal(rest, '')}"


def _digits(digits: str, zero: str) -> str:
    return " ".join(zero if digit == "0" else _SMALL[int(digit)] for digit in digits)
