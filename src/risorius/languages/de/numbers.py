"""German words for whole numbers: quantities, ordinals and years."""

from __future__ import annotations

_SMALL = (
    "null", "eins", "zwei", "drei", "vier", "fünf", "sechs", "sieben", "acht", "neun", "zehn", "elf", "zwölf",
    "dreizehn", "vierzehn", "fünfzehn", "sechzehn", "siebzehn", "achtzehn", "neunzehn",
)  # fmt: skip
_TENS = ("zwanzig", "dreißig", "vierzig", "fünfzig", "sechzig", "siebzig", "achtzig", "neunzig")
_ORDINALS = {"eins": "erst", "drei": "dritt", "sieben": "siebt", "acht": "acht"}
_CENTURIES = range(1100, 2000)
LARGEST = 1_000_000


def cardinal(number: int) -> str:
    """Return a whole number below a million.

    >>> cardinal(21), cardinal(101), cardinal(2021)
    ('einundzwanzig', 'einhunderteins', 'zweitausendeinundzwanzig')
    """
    if number < 20:
        return _SMALL[number]
    if number < 100:
        tens, ones = divmod(number, 10)
        return (f"{_joined(ones)}und" if ones else "") + _TENS[tens - 2]
    scale, name = (100, "hundert") if number < 1000 else (1000, "tausend")
    count, rest = divmod(number, scale)
    return _joined(count) + name + (cardinal(rest) if rest else "")


def ordinal(number: int, ending: str = "e") -> str:
    """Return a whole number below a million as an ordinal with the ending of its case.

    >>> ordinal(3, "en"), ordinal(7), ordinal(20), ordinal(23, "er")
    ('dritten', 'siebte', 'zwanzigste', 'dreiundzwanzigster')
    """
    words, rest = cardinal(number), number % 100
    if 0 < rest < 20:
        last = _SMALL[rest]
        stem = words.removesuffix(last) + _ORDINALS.get(last, f"{last}t")
    else:
        stem = f"{words}st"
    return stem + ending


def year(number: int) -> str:
    """Return a year, by its century from 1100 to 1999.

    >>> year(1998), year(2021), year(1900)
    ('neunzehnhundertachtundneunzig', 'zweitausendeinundzwanzig', 'neunzehnhundert')
    """
    if number not in _CENTURIES:
        return cardinal(number)
    century, rest = divmod(number, 100)
    return f"{cardinal(century)}hundert" + (cardinal(rest) if rest else "")


def _joined(number: int) -> str:
    """Return a number as it stands before another part of a word: "ein", not "eins"."""
    words = cardinal(number)
    return "ein" if number == 1 else words.removesuffix("s") if words.endswith("hunderteins") else words
