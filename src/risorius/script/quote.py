"""Showing a user's own text in a message of one line."""

from __future__ import annotations

_LONGEST = 40
LONGEST_PATH = 1000


def one_line(text: str, longest: int = _LONGEST) -> str:
    """Return `text` on one line of at most `longest` characters; unprintable characters become spaces."""
    shown = "".join(c if c.isprintable() else " " for c in text[: longest + 1])
    return shown if len(shown) <= longest else shown[: longest - 1] + "…"


def quoted(text: str) -> str:
    """Return `text` on one line, in quotation marks, shortened."""
    return f"'{one_line(text)}'"
