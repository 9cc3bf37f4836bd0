"""Characters that texts, words and captions treat in a way of their own."""

from __future__ import annotations

HIDDEN = "\u200b"
"""Stands in a text for a character that is neither spoken nor shown, such as a mark of Markdown."""
BLOCK_END = "\u2029"
"""Stands in a text for a line end with which a sentence ends, as after a heading or an item of a list."""


def stands_alone(char: str) -> bool:
    """Tell whether a character stands without blanks around it: a Chinese character, or Japanese kana."""
    return (
        ("\u3040" <= char <= "\u30ff" and char != "\u30fb")
        or "\u3400" <= char <= "\u4dbf"
        or "\u4e00" <= char <= "\u9fff"
        or "\U00020000" <= char <= "\U0003134f"
    )


def shown(text: str) -> str:
    """Return a text as it is shown to readers: without hidden characters, separators as line ends."""
    return text.replace(HIDDEN, "").replace(BLOCK_END, "\n")
