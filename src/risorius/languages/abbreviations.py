"""Abbreviations, money and units, written out as they are read (`abbreviations.toml` of a language)."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator, Mapping, Set
from dataclasses import dataclass, field
from typing import NamedTuple

# Text, and the source offset that it comes from.
ReadText = tuple[str, int]

# Python refuses to read thousands of digits, and nobody says them.
_AMOUNT = r"\d{1,15}(?:,\d{3}){0,5}(?:\.\d{1,15})?(?![\d])"
_MONEY = re.compile(
    r"(?P<sign>.) ?(?P<amount>(?P<whole>\d+(?:,\d{3})*)(?:\.(?P<cents>\d+))?) ?(?P<magnitude>\D*)"
)
# How far around a full stop an abbreviation is looked for, and what follows it (characters).
_BEFORE, _AFTER, _REST = 12, 4, 40


class Replacement(NamedTuple):
    """A stretch [start, end) of the source, and what is read in its place.

    `joined`: each text that is read belongs to one word, which ends where the next one begins.
    """

    start: int
    end: int
    read: tuple[ReadText, ...]
    joined: bool = False


@dataclass(frozen=True)
class Abbreviations:
    """The file `abbreviations.toml`. Keys are lower case, without the last full stop.

    `titles` end no sentence; `words` do if a capital letter or nothing follows. `numbered` stand before a
    number, in the case of the key, `units` after one. `before_name`: what is read before a name, and else.
    `currencies`: by sign, one and several, one hundredth and several; `magnitudes` may follow the amount.
    `interjections` are sounds that are written without a vowel. `range`: what is read between two numbers.
    `ordinals`: a number of one or two digits with a full stop is an ordinal, which ends no sentence.
    """

    titles: Mapping[str, str] = field(default_factory=dict)
    words: Mapping[str, str] = field(default_factory=dict)
    numbered: Mapping[str, str] = field(default_factory=dict)
    before_name: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    currencies: Mapping[str, tuple[str, str, str, str]] = field(default_factory=dict)
    magnitudes: Mapping[str, str] = field(default_factory=dict)
    interjections: Mapping[str, str] = field(default_factory=dict)
    range: str = ""
    ordinals: bool = False

    @functools.cached_property
    def pattern(self) -> re.Pattern[str]:
        """A pattern that finds all text that is read otherwise than written; its groups are the kinds."""
        kinds = {kind: rule for kind, rule in _rules(self) if rule is not None}
        return re.compile("|".join(f"(?P<{kind}>{rule})" for kind, rule in kinds.items()))


def _rules(table: Abbreviations) -> Iterator[tuple[str, str | None]]:
    """Yield the kinds in order, each with its regular expression; None if the table has none of the kind."""

    def of(entries: Mapping[str, object], rule: str) -> str | None:
        return rule.replace("KEYS", _either(entries)) if entries else None

    signs = re.escape("".join(table.currencies))
    magnitude = of(table.magnitudes, r"(?:\ ?(?:KEYS)\b)?") or ""
    yield "scheme", r"(?i:\bhttps?://)"
    yield "money", of(table.currencies, rf"[{signs}]\ ?{_AMOUNT}{magnitude}")
    yield "range", r"(?<=\d)\u2013(?=\d)" if table.range else None
    yield "unit", of(table.units, r"(?i:(?<=\d)\ ?(?:KEYS)(?!\w))")
    yield "numbered", of(table.numbered, r"(?<![\w.])(?:KEYS)\.(?=\ ?\d)")
    yield "before_name", of(table.before_name, r"(?<![\w.])(?:KEYS)\.(?!\w)")
    yield "title", of(table.titles, r"(?i:(?<![\w.])(?:KEYS)\.(?!\w))")
    yield "word", of(table.words, r"(?i:(?<![\w.])(?:KEYS)\.(?!\w))")
    yield "acronym", r"(?<![\w.])(?:[A-Za-z]\.){2,}(?!\w)"
    # A lone letter before a name; "I" is a word.
    yield "initial", r"(?<![\w.'\u2019])[A-HJ-Z]\.(?=\ ?[A-Z])"
    yield "interjection", of(table.interjections, r"(?i:\b(?:KEYS)\b)")
    yield "ordinal", r"(?<![\w.,])\d{1,2}\.(?=\ \w)" if table.ordinals else None
    yield "dash", r"--+"


def _either(entries: Mapping[str, object]) -> str:
    return "|".join(re.escape(key) for key in sorted(entries, key=len, reverse=True))


def written_out(
    text: str,
    start: int,
    end: int,
    table: Abbreviations,
    function_words: Set[str],
    *,
    stop: int | None = None,
) -> Iterator[Replacement]:
    """Yield what of characters [start, end) of a text is read otherwise than it is written.

    `stop`: where the text ends that tells whether a sentence goes on, by default `end`.
    """
    stop = end if stop is None else stop
    for match in table.pattern.finditer(text, start, stop):
        if match.start() >= end:
            return
        if match.end() > end:
            continue
        kind, rest = str(match.lastgroup), text[match.end() : stop]
        reader = _READERS.get(kind)
        if reader is not None:
            read = reader(match, rest, table)
        elif kind in _INITIALS:
            read = _read_initials(match, rest, function_words)
        else:
            continue
        yield Replacement(match.start(), match.end(), tuple(read))


def is_abbreviation(text: str, stop: int, table: Abbreviations, function_words: Set[str]) -> bool:
    """Tell whether the full stop at offset `stop` belongs to an abbreviation and ends no sentence."""
    for match in table.pattern.finditer(text, max(0, stop - _BEFORE), min(len(text), stop + _AFTER)):
        if match.start() <= stop < match.end() - 1:
            # The first of several, as in "z. B."
            return True
        if match.end() == stop + 1:
            rest = text[stop + 1 : stop + _REST]
            if match.lastgroup == "word":
                return not ends_sentence(rest)
            if match.lastgroup in _INITIALS:
                return not _begins_anew(rest, function_words)
            return match.lastgroup in ("title", "before_name", "numbered", "ordinal")
    return False


def ends_sentence(rest: str) -> bool:
    """Tell whether the text after a full stop begins a new sentence: a capital letter, or nothing."""
    following = next((char for char in rest if char.isalnum()), "")
    return not following or (following.isupper() and rest[:1].isspace())


def _begins_anew(rest: str, function_words: Set[str]) -> bool:
    """Tell whether a sentence begins after initials: with "The" or "He" rather than with a name."""
    following = re.match(r"\W*(\w*)", rest)
    return ends_sentence(rest) and (following is None or following[1].lower() in {"", *function_words})


def _read_entry(match: re.Match[str], rest: str, table: Abbreviations) -> Iterator[ReadText]:
    """Yield what the table has for a match, after a blank for a unit, with the full stop of a sentence."""
    kind, written = str(match.lastgroup), match.group()
    entries: Mapping[str, str] = getattr(table, _TABLES[kind])
    key = written.strip().removesuffix(".")
    reading = entries[key if key in entries else key.lower()]
    yield (" " if kind == "unit" else "") + reading, match.start() + len(written) - len(written.lstrip())
    if kind == "word" and ends_sentence(rest):
        yield ".", match.end() - 1


def _read_scheme(match: re.Match[str], _: str, __: Abbreviations) -> Iterator[ReadText]:
    yield "", match.start()


def _read_dash(match: re.Match[str], _: str, __: Abbreviations) -> Iterator[ReadText]:
    yield "\u2014", match.start()


def _read_range(match: re.Match[str], _: str, table: Abbreviations) -> Iterator[ReadText]:
    yield f" {table.range} ", match.start()


def _read_before_name(match: re.Match[str], rest: str, table: Abbreviations) -> Iterator[ReadText]:
    before_name, otherwise = table.before_name[match.group().removesuffix(".")]
    yield before_name if ends_sentence(rest) and rest.strip() else otherwise, match.start()


def _read_initials(match: re.Match[str], rest: str, function_words: Set[str]) -> Iterator[ReadText]:
    yield match.group()[:-1], match.start()
    if _begins_anew(rest, function_words):
        yield ".", match.end() - 1
    elif rest[:1].isalnum():
        yield " ", match.end() - 1


def _read_money(match: re.Match[str], _: str, table: Abbreviations) -> Iterator[ReadText]:
    parts = _MONEY.fullmatch(match.group())
    assert parts is not None
    one, several, hundredth, hundredths = table.currencies[parts["sign"]]
    whole, cents, magnitude = int(parts["whole"].replace(",", "")), parts["cents"] or "", parts["magnitude"]
    if magnitude:
        yield f"{parts['amount']} ", match.start()
        yield f"{table.magnitudes[magnitude]} {several}", match.end() - len(magnitude)
    elif len(cents) not in (0, 2):
        yield f"{parts['amount']} {several}", match.start()
    else:
        names = []
        if whole or not int(cents or 0):
            names.append(f"{parts['whole']} {one if whole == 1 else several}")
        if int(cents or 0):
            names.append(f"{int(cents)} {hundredth if int(cents) == 1 else hundredths}")
        yield " ".join(names), match.start()


# The table of each kind whose entries are read as they stand.
_TABLES = {
    "unit": "units",
    "numbered": "numbered",
    "title": "titles",
    "word": "words",
    "interjection": "interjections",
}
_INITIALS = ("acronym", "initial")
_READERS: dict[str, Callable[[re.Match[str], str, Abbreviations], Iterator[ReadText]]] = {
    **dict.fromkeys(_TABLES, _read_entry),
    "scheme": _read_scheme,
    "money": _read_money,
    "range": _read_range,
    "before_name": _read_before_name,
    "dash": _read_dash,
}
