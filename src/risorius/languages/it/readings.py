"""Italian ordinals and amounts."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..amounts import Amounts, amount_rules
from ..readings import AS_DIGITS, Pieces, ReadingRule, ReadingTable, any_of

NUMBERS = AS_DIGITS
# One o'clock is "l'una": the article loses its vowel, and is one word with the hour.
_ONE = re.compile(r"\b(?P<word>[Aa]lle|[Dd]alle|[Ll]e) 0?1[:.](?P<minute>[0-5]\d)(?![\w:/-]|[.,]\d)")


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of Italian."""
    months = any_of(table.dates.months)
    # "1° aprile" and "il 2° posto", but not "20° all'ombra".
    ordinal = re.compile(
        rf"(?<![\w.,/-])(?:(?P<number>\d{{1,2}})°(?= (?:{months})\b)"
        r"|(?<=\b(?:il|Il|al|Al|un|Un) )(?P<number2>\d{1,3})°(?= [a-zà-ù]))"
    )
    yield ReadingRule(ordinal, lambda match: [(f"{match['number'] or match['number2']}º", match.start())])
    first = re.compile(rf"(?<![\w.,/-])1(?= (?:{months})\b)")
    yield ReadingRule(first, lambda match: [("primo", match.start())])
    yield ReadingRule(_ONE, _one)
    yield from amount_rules(table, Amounts())


def _one(match: re.Match[str]) -> Pieces:
    minute = int(match["minute"])
    words = f"{match['word'][:-1]}'una"
    return [(f"{words} e {minute}" if minute else words, match.start())]
