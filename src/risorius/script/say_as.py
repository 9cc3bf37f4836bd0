"""Reading of SSML's `say-as` aloud: words for words."""

from __future__ import annotations

from collections.abc import Callable, Mapping


def said_as(kind: str, words: str, form: str | None = None) -> str | None:
    """Return what is said for `words`, by `interpret-as` and `format`; None for a kind that is not known."""
    reader = SAY_AS.get(kind)
    return None if reader is None else reader(words)


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
}
"""The reader of each `interpret-as`."""
