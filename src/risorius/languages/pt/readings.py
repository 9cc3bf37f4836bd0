"""Portuguese ordinals, rulers and centuries, and amounts."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..amounts import Amounts, amount_rules
from ..readings import AS_DIGITS, Pieces, ReadingRule, ReadingTable, any_of
from ..roman import ROMAN, roman_value

NUMBERS = AS_DIGITS
_ONES = ("", "primeir", "segund", "terceir", "quart", "quint", "sext", "sétim", "oitav", "non")
_TENS = (
    "", "décim", "vigésim", "trigésim", "quadragésim", "quinquagésim", "sexagésim", "septuagésim",
    "octogésim", "nonagésim",
)  # fmt: skip
_ORDINAL = re.compile(r"(?<![\w.,/-])(?P<number>\d{1,2})\.?(?P<sign>[\u00ba\u00aa])(?!\w)")
# A numeral of several letters after another word with a capital letter: "Capítulo II".
_OTHER = re.compile(
    r"\b(?P<name>[A-ZÁÉÍÓÚ][a-záéíóúâêôãõç]{2,}) (?P<numeral>(?=[IVX]{2})X{0,3}(?:IX|IV|V?I{0,3}))"
    r"(?!\w)(?!\.\w)"
)


def rules(table: ReadingTable) -> Iterator[ReadingRule]:
    """Yield the rules of Portuguese."""
    yield ReadingRule(_ORDINAL, _ordinal)
    words = table.own["numbered"]
    after = re.compile(rf"\b(?P<name>{any_of(words)}) (?P<numeral>{ROMAN})(?!\w)(?!\.\w)")
    yield ReadingRule(after, lambda match: _numbered(match, words[match["name"]]))
    yield ReadingRule(_OTHER, lambda match: _numbered(match, "o"))
    yield from amount_rules(table, Amounts())


def ordinal(number: int, ending: str = "o") -> str:
    """Return a whole number from 1 to 99 as an ordinal; `ending`: o or a.

    >>> ordinal(1), ordinal(2, "a"), ordinal(21)
    ('primeiro', 'segunda', 'vigésimo primeiro')
    """
    tens, ones = divmod(number, 10)
    return " ".join(f"{stem}{ending}" for stem in (_TENS[tens], _ONES[ones]) if stem)


def _ordinal(match: re.Match[str]) -> Pieces:
    number = int(match["number"])
    if number == 0:
        return None
    return [(ordinal(number, "o" if match["sign"] == "\u00ba" else "a"), match.start())]


def _numbered(match: re.Match[str], ending: str) -> Pieces:
    """Read a numeral after a name: up to ten as an ordinal, from eleven on as a number."""
    number, name = roman_value(match["numeral"]), match["name"]
    words = ordinal(number, ending) if number <= 10 else str(number)
    return [(name, match.start()), (f" {words}", match.start("numeral"))]
