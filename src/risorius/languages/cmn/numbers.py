"""Mandarin words for whole numbers, which the voice reads only below a hundred."""

from __future__ import annotations

import re

DIGITS = "零一二三四五六七八九"
_PLACES = ("千", "百", "十", "")
_GROUPS = ("", "万", "亿", "万亿")
_LARGEST = 16


def cardinal(number: int) -> str:
    """Return a whole number below 10 to the power of 16.

    >>> cardinal(115), cardinal(10500), cardinal(12345), cardinal(200000), cardinal(1000000000)
    ('一百一十五', '一万零五百', '一万两千三百四十五', '二十万', '十亿')
    """
    if number == 0:
        return DIGITS[0]
    words = ""
    for place in range(len(_GROUPS) - 1, -1, -1):
        group = number // 10 ** (4 * place) % 10000
        if group == 0:
            continue
        gap = words and (group < 1000 or number // 10 ** (4 * place + 4) % 10000 == 0)
        said = "两" if group == 2 and place and not words else _group(group)
        words += (DIGITS[0] if gap else "") + said + _GROUPS[place]
    if words.startswith("一十"):
        words = words[1:]
    return words


def spoken(digits: str) -> str:
    """Return a number, perhaps with decimals, as the voice is given it: words from a hundred on.

    >>> spoken("12"), spoken("12,345"), spoken("150.25")
    ('12', '一万两千三百四十五', '一百五十点二五')
    """
    whole, _, decimals = re.sub(r"[^\d.]", "", digits).partition(".")
    if len(whole) > _LARGEST or (whole.startswith("0") and len(whole) > 1):
        words = spelt(whole)
    elif int(whole) < 100:
        return f"{whole}.{decimals}" if decimals else whole
    else:
        words = cardinal(int(whole))
    return f"{words}点{spelt(decimals)}" if decimals else words


def spelt(digits: str) -> str:
    """Return digits one by one."""
    return "".join(DIGITS[int(digit)] for digit in digits)


def _group(number: int) -> str:
    """Return a number below 10000; 2 is liǎng before thousands, and before 万 and 亿 alone."""
    words, gap = "", False
    for digit, place in zip(f"{number:04d}", _PLACES, strict=True):
        if digit == "0":
            gap = bool(words)
            continue
        words += (
            (DIGITS[0] if gap else "")
            + ("两" if digit == "2" and place == "千" else DIGITS[int(digit)])
            + place
        )
        gap = False
    return words
