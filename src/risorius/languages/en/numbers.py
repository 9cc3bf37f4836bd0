"""English words for whole numbers: quantities, with or without "and", ordinals, years, digits."""

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
_ORDINALS = {
    "one": "first", "two": "second", "three": "third", "five": "fifth", "eight": "eighth", "nine": "ninth",
    "twelve": "twelfth",
}  # fmt: skip
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
    found = [cardinal(number), cardinal(number, "and ")] if digits == str(number) else []
    if number in _YEARS and len(digits) == 4 and number % 1000 >= 10:
        found.append(_by_century(number))
    if len(digits) > 1:
        found += [spelt(digits, "oh"), spelt(digits, "zero")]
    return tuple(dict.fromkeys(found))


def ordinal(number: int) -> str:
    """Return a whole number below a thousand billion as an ordinal.

    >>> ordinal(21), ordinal(112)
    ('twenty first', 'one hundred twelfth')
    """
    before, blank, last = cardinal(number).rpartition(" ")
    regular = f"{last[:-1]}ieth" if last.endswith("y") else f"{last}th"
    return before + blank + _ORDINALS.get(last, regular)


def year(number: int) -> str:
    """Return a year: by its century from 1100 on, but for the first ten years of a thousand.

    >>> year(1905), year(2005), year(2021), year(1900)
    ('nineteen oh five', 'two thousand five', 'twenty twenty one', 'nineteen hundred')
    """
    return _by_century(number) if number in _YEARS and number % 1000 >= 10 else cardinal(number)


def cardinal(number: int, joint: str = "") -> str:
    """Return a whole number below a thousand billion; `joint` stands before its last two digits.

    >>> cardinal(1250, "and ")
    'one thousand two hundred and fifty'
    """
    if number < 20:
        return _SMALL[number]
    if number < 100:
        tens, ones = divmod(number, 10)
        return _TENS[tens - 2] + (f" {_SMALL[ones]}" if ones else "")
    if number < 1000:
        hundreds, rest = divmod(number, 100)
        return f"{_SMALL[hundreds]} hundred" + (f" {joint}{cardinal(rest, joint)}" if rest else "")
    scale, name = next(entry for entry in _SCALES if number >= entry[0])
    count, rest = divmod(number, scale)
    links = joint if 0 < rest < 100 else ""
    return f"{cardinal(count, joint)} {name}" + (f" {links}{cardinal(rest, joint)}" if rest else "")


def _by_century(number: int) -> str:
    century, rest = divmod(number, 100)
    if rest == 0:
        return f"{cardinal(century, '')} hundred"
    return f"{cardinal(century, '')} {f'oh {_SMALL[rest]}' if rest < 10 else cardinal(rest, '')}"


def by_pairs(digits: str) -> str:
    """Return a number of three digits as of a house or a pressure, others as usual.

    >>> by_pairs("120"), by_pairs("305"), by_pairs("300"), by_pairs("45")
    ('one twenty', 'three oh five', 'three hundred', 'forty five')
    """
    number = int(digits)
    if len(digits) != len("120") or number % 100 == 0:
        return cardinal(number)
    rest = number % 100
    return f"{cardinal(number // 100)} {f'oh {cardinal(rest)}' if rest < 10 else cardinal(rest)}"


def spelt(digits: str, zero: str = "oh") -> str:
    """Return digits one by one."""
    return " ".join(zero if digit == "0" else _SMALL[int(digit)] for digit in digits)
