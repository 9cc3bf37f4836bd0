"""English abbreviations, money and units, written out as they are read (`data/english.toml`)."""

from __future__ import annotations

import functools
import re
import tomllib
from collections.abc import Callable, Iterator
from importlib import resources
from typing import Any, NamedTuple

# Text, and the source offset that it comes from.
Read = tuple[str, int]
# What a stretch is read as, given its match and the rest of the text.
Reader = Callable[["re.Match[str]", str], Iterator[Read]]

_AMOUNT = r"\d+(?:,\d{3})*(?:\.\d+)?"
_MONEY = re.compile(
    r"(?P<sign>.) ?(?P<amount>(?P<whole>\d+(?:,\d{3})*)(?:\.(?P<cents>\d+))?) ?(?P<magnitude>\D*)"
)


class Piece(NamedTuple):
    """A stretch [start, end) of the source, and what is read in its place."""

    start: int
    end: int
    read: tuple[Read, ...]


def written_out(text: str, start: int, end: int) -> Iterator[Piece]:
    """Yield what of characters [start, end) of an English text is read otherwise than it is written."""
    for match in _pattern().finditer(text, start, end):
        reader = _READERS[str(match.lastgroup)]
        yield Piece(match.start(), match.end(), tuple(reader(match, text[match.end() : end])))


def is_abbreviation(text: str, stop: int) -> bool:
    """Tell whether the full stop at offset `stop` belongs to an abbreviation and ends no sentence."""
    for match in _pattern().finditer(text, max(0, stop - 12), min(len(text), stop + 4)):
        if match.end() == stop + 1:
            rest = text[stop + 1 : stop + 40]
            if match.lastgroup == "word":
                return not ends_sentence(rest)
            if match.lastgroup in ("initial", "acronym"):
                return not _begins_anew(rest)
            return match.lastgroup in ("title", "saint", "numbered")
    return False


@functools.cache
def function_words() -> frozenset[str]:
    """Return the English words that normally carry no accent, in lower case (`data/function_words.txt`)."""
    lines = resources.files(__package__).joinpath("data/function_words.txt").read_text("utf-8").splitlines()
    return frozenset(word for line in lines if not line.startswith("#") for word in line.split())


def ends_sentence(rest: str) -> bool:
    """Tell whether the text after a full stop begins a new sentence: a capital letter, or nothing."""
    following = next((char for char in rest if char.isalnum()), "")
    return not following or (following.isupper() and rest[:1].isspace())


def _begins_anew(rest: str) -> bool:
    """Tell whether a sentence begins after initials: with "The" or "He" rather than with a name."""
    following = re.match(r"\W*(\w*)", rest)
    return ends_sentence(rest) and (following is None or following[1].lower() in {"", *function_words()})


@functools.cache
def _data() -> dict[str, dict[str, Any]]:
    return tomllib.loads(resources.files(__package__).joinpath("data/english.toml").read_text("utf-8"))


@functools.cache
def _pattern() -> re.Pattern[str]:
    def either(table: str) -> str:
        return "|".join(re.escape(key) for key in sorted(_data()[table], key=len, reverse=True))

    signs = re.escape("".join(_data()["currencies"]))
    kinds = {
        "scheme": r"(?i:\bhttps?://)",
        "money": rf"[{signs}]\ ?{_AMOUNT}(?:\ ?(?:{either('magnitudes')})\b)?",
        "range": r"(?<=\d)\u2013(?=\d)",
        "unit": rf"(?i:(?<=\d)\ ?(?:{either('units')})(?!\w))",
        "numbered": rf"(?<![\w.])(?:{either('numbered')})\.(?=\ ?\d)",
        "saint": r"(?<![\w.])St\.(?!\w)",
        "title": rf"(?i:(?<![\w.])(?:{either('titles')})\.(?!\w))",
        "word": rf"(?i:(?<![\w.])(?:{either('words')})\.(?!\w))",
        "acronym": r"(?<![\w.])(?:[A-Za-z]\.){2,}(?!\w)",
        # A lone letter before a name; "I" is a word.
        "initial": r"(?<![\w.'\u2019])[A-HJ-Z]\.(?=\ ?[A-Z])",
        "interjection": rf"(?i:\b(?:{either('interjections')})\b)",
        "dash": r"--+",
    }
    return re.compile("|".join(f"(?P<{kind}>{rule})" for kind, rule in kinds.items()))


def _from_table(table: str) -> Reader:
    def read(match: re.Match[str], rest: str) -> Iterator[Read]:
        written = match.group()
        key = written.strip().removesuffix(".")
        entries = _data()[table]
        separator = " " if table == "units" else ""
        reading = str(entries[key if key in entries else key.lower()])
        yield separator + reading, match.start() + len(written) - len(written.lstrip())
        if table == "words" and ends_sentence(rest):
            yield ".", match.end() - 1

    return read


def _always(reading: str) -> Reader:
    def read(match: re.Match[str], _: str) -> Iterator[Read]:
        yield reading, match.start()

    return read


def _read_saint(match: re.Match[str], rest: str) -> Iterator[Read]:
    yield "Saint" if ends_sentence(rest) and rest.strip() else "Street", match.start()


def _read_initials(match: re.Match[str], rest: str) -> Iterator[Read]:
    yield match.group()[:-1], match.start()
    if _begins_anew(rest):
        yield ".", match.end() - 1
    elif rest[:1].isalnum():
        yield " ", match.end() - 1


def _read_money(match: re.Match[str], _: str) -> Iterator[Read]:
    parts = _MONEY.fullmatch(match.group())
    assert parts is not None
    one, several, hundredth, hundredths = _data()["currencies"][parts["sign"]]
    whole, cents, magnitude = int(parts["whole"].replace(",", "")), parts["cents"] or "", parts["magnitude"]
    if magnitude:
        yield f"{parts['amount']} ", match.start()
        yield f"{_data()['magnitudes'][magnitude]} {several}", match.end() - len(magnitude)
    elif len(cents) not in (0, 2):
        yield f"{parts['amount']} {several}", match.start()
    else:
        names = []
        if whole or not int(cents or 0):
            names.append(f"{parts['whole']} {one if whole == 1 else several}")
        if int(cents or 0):
            names.append(f"{int(cents)} {hundredth if int(cents) == 1 else hundredths}")
        yield " ".join(names), match.start()


_READERS: dict[str, Reader] = {
    "scheme": _always(""),
    "money": _read_money,
    "range": _always(" to "),
    "unit": _from_table("units"),
    "numbered": _from_table("numbered"),
    "saint": _read_saint,
    "title": _from_table("titles"),
    "word": _from_table("words"),
    "acronym": _read_initials,
    "initial": _read_initials,
    "interjection": _from_table("interjections"),
    "dash": _always("\u2014"),
}
