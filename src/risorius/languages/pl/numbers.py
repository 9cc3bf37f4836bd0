"""Polish words for whole numbers: ordinals in their cases, and years."""

from __future__ import annotations

_HUNDREDS = (
    "", "sto", "dwieście", "trzysta", "czterysta", "pięćset", "sześćset", "siedemset", "osiemset",
    "dziewięćset",
)  # fmt: skip
_STEMS = (
    "", "pierwsz", "drug", "trzec", "czwart", "piąt", "szóst", "siódm", "ósm", "dziewiąt", "dziesiąt",
    "jedenast", "dwunast", "trzynast", "czternast", "piętnast", "szesnast", "siedemnast", "osiemnast",
    "dziewiętnast",
)  # fmt: skip
_TENS = (
    "", "", "dwudziest", "trzydziest", "czterdziest", "pięćdziesiąt", "sześćdziesiąt", "siedemdziesiąt",
    "osiemdziesiąt", "dziewięćdziesiąt",
)  # fmt: skip
_ROUND = (
    "", "setn", "dwusetn", "trzechsetn", "czterechsetn", "pięćsetn", "sześćsetn", "siedemsetn",
    "osiemsetn", "dziewięćsetn",
)  # fmt: skip
_THOUSANDS = {1: ("tysiąc", "tysięczn"), 2: ("dwa tysiące", "dwutysięczn")}


def ordinal(number: int, ending: str) -> str:
    """Return a whole number from 1 to 99 as an ordinal; `ending`: y, ego, emu, ym, a, ej or ą.

    >>> ordinal(23, "ego"), ordinal(3, "a"), ordinal(22, "ej"), ordinal(40, "ym")
    ('dwudziestego trzeciego', 'trzecia', 'dwudziestej drugiej', 'czterdziestym')
    """
    if number < 20:
        return _with_ending(_STEMS[number], ending)
    tens, ones = divmod(number, 10)
    words = _with_ending(_TENS[tens], ending)
    return f"{words} {_with_ending(_STEMS[ones], ending)}" if ones else words


def year(number: int, ending: str = "ego") -> str:
    """Return a year from 1000 to 2999 as an ordinal: only tens and ones change with the case.

    >>> year(1998, "ym"), year(2000, "y"), year(1900)
    ('tysiąc dziewięćset dziewięćdziesiątym ósmym', 'dwutysięczny', 'tysiąc dziewięćsetnego')
    """
    thousands, rest = divmod(number, 1000)
    hundreds, last = divmod(rest, 100)
    if thousands not in _THOUSANDS:
        return str(number)
    head, stem = _THOUSANDS[thousands]
    if last:
        return " ".join(part for part in (head, _HUNDREDS[hundreds], ordinal(last, ending)) if part)
    return f"{head} {_with_ending(_ROUND[hundreds], ending)}" if hundreds else _with_ending(stem, ending)


def _with_ending(stem: str, ending: str) -> str:
    if stem.endswith("g"):
        ending = {"y": "i", "a": "a", "ą": "ą", "ym": "im"}.get(ending, f"i{ending}")
    elif stem.endswith("c"):
        ending = {"y": "i", "ym": "im"}.get(ending, f"i{ending}")
    return stem + ending
