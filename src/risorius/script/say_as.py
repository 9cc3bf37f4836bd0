"""Reading of SSML's `say-as` aloud: words for words."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping


def said_as(kind: str, words: str, form: str | None = None) -> str | None:
    """Return what is said for `words`, by `interpret-as` and `format`; None for a kind that is not known."""
    if kind == "date":
        return _date(words, (form or "").lower())
    reader = SAY_AS.get(kind)
    return None if reader is None else reader(words)


def _date(words: str, form: str) -> str | None:
    """Return a date of three numbers as the language reads one (ISO 8601); None for other formats."""
    numbers = re.findall(r"\d+", words)
    is_date = len(numbers) == len("dmy") and max(map(len, numbers)) <= len("2021")
    if is_date and sorted(form) == sorted("dmy"):
        parts = dict(zip(form, map(int, numbers), strict=True))
        year = parts["y"] + (2000 if parts["y"] < 50 else 1900 if parts["y"] < 100 else 0)
        return f"{year:04d}-{parts['m']:02d}-{parts['d']:02d}"
    return None if form else words


def _spelt(words: str) -> str:
    return ", ".join(char.upper() for char in words if char.isalnum())


def _digits(words: str) -> str:
    return " ".join(char for char in words if char.isalnum())


def _ordinal(words: str) -> str:
    if not words.isascii() or not words.isdigit():
        return words
    teen = words[-2:-1] == "1"
    return words + ("th" if teen else {"1": "st", "2": "nd", "3": "rd"}.get(words[-1], "th"))


def _as_written(words: str) -> str:
    return words


def _nothing(_: str) -> str:
    return ""


SAY_AS: Mapping[str, Callable[[str], str]] = {
    "characters": _spelt,
    "spell-out": _spelt,
    "verbatim": _spelt,
    "digits": _digits,
    "telephone": _digits,
    "ordinal": _ordinal,
    "cardinal": _as_written,
    "number": _as_written,
    "currency": _as_written,
    "unit": _as_written,
    "time": _as_written,
    "fraction": _as_written,
    "address": _as_written,
    "duration": _as_written,
    "spell": _spelt,
    "alphanumeric": _spelt,
    "expletive": _nothing,
    "bleep": _nothing,
}
"""The reader of each `interpret-as`; what is written is read as the language reads it."""
