"""Readings of Japanese with kanji by OpenJTalk, which the extra `risorius[ja]` installs."""

from __future__ import annotations

import contextlib
import io
import re
import unicodedata
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, cast

from ...errors import SpeechError
from ..abbreviations import ReadText, Replacement

HAN = re.compile("[\u3400-\u4dbf\u4e00-\u9fff\U00020000-\U0003134f\u3005-\u3007]")
# Stretches between punctuation and blanks.
_STRETCH = re.compile(
    r"(?:[^\s\u3001\u3002\uff01\uff1f\uff0c\uff0e!?,;:\u300c-\u300f()\uff08\uff09\u2026\u30fb]|(?<=\d),(?=\d))+"
)
_DIGITS = re.compile(r"(?:\d|[,.]{1,9}+\d)++")
_NUMERALS = "〇零一二三四五六七八九十百千万億兆・点．."
_MEASURED = r"(?<![A-Za-z\d.,])(\d{1,9}(?:\.\d{1,9})?) ?"
# What OpenJTalk reads sign by sign, or leaves out, and what to give it instead.
_WRITTEN = (
    (re.compile(r"(?<![\d/-])(\d{4})[-/](\d{1,2})[-/](\d{1,2})(?![\d/-])"), r"\1年\2月\3日"),
    (re.compile(r"(?<![\d:])([01]?\d|2[0-4]):00(?![\d:])"), r"\1時"),
    (re.compile(r"(?<![\d:])([01]?\d|2[0-4]):([0-5]\d)(?![\d:])"), r"\1時\2分"),
    (re.compile(r"(?<![\d/.])(\d{1,2})/(\d{1,2})(?![\d/])"), r"\2分の\1"),
    (re.compile(r"(?<![\dA-Za-z.])[-\u2212](\d+(?:\.\d+)?) ?(?:°C|℃|度)"), r"マイナス\1度"),
    (re.compile(r"(?<![\dA-Za-z.])[-\u2212](\d+(?:\.\d+)?)"), r"マイナス\1"),
    (re.compile(r"(?<![\w.-])(\d+(?:\.\d+)?) ?(?:°C|℃)"), r"\1度"),
    (re.compile(r"[¥\uffe5] ?(\d{1,3}(?:,\d{3}){1,5}|\d{1,15})(?![\d,.])"), r"\1円"),
    (re.compile(r"[$\uff04] ?(\d{1,3}(?:,\d{3}){1,5}|\d{1,15})(?![\d,.])"), r"\1ドル"),
    (re.compile(rf"{_MEASURED}kg(?![A-Za-z/])"), r"\1キログラム"),
    (re.compile(rf"{_MEASURED}km(?![A-Za-z/])"), r"\1キロメートル"),
    (re.compile(rf"{_MEASURED}cm(?![A-Za-z/])"), r"\1センチメートル"),
    (re.compile(rf"{_MEASURED}m(?![A-Za-z/])"), r"\1メートル"),
)
_MARKS = "\u2019'"

Features = Sequence[Mapping[str, Any]]
Frontend = Callable[[str], Features]


def kanji_readings(text: str) -> tuple[Replacement, ...]:
    """Return the words of a text with kanji, in kana; each is a word of the text.

    Raises SpeechError if the extra is not installed.
    """
    if HAN.search(text) is None:
        return ()
    frontend = _quiet(_frontend())
    found: list[Replacement] = []
    for pattern, said_as in _WRITTEN:
        for match in pattern.finditer(text):
            said = ((_said(frontend(match.expand(said_as))), match.start()),)
            found.append(Replacement(match.start(), match.end(), said, joined=True))
            text = text[: match.start()] + " " * len(match[0]) + text[match.end() :]
    for stretch in _STRETCH.finditer(text):
        if not stretch[0].isascii():
            pieces = tuple(_pieces(stretch[0], frontend(stretch[0]), stretch.start()))
            if pieces:
                found.append(Replacement(stretch.start(), stretch.end(), pieces, joined=True))
    return tuple(sorted(found))


def _quiet(frontend: Frontend) -> Frontend:
    """Return OpenJTalk without the warnings of deprecation of packages that it uses."""

    def read(text: str) -> Features:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)
            return frontend(text)

    return read


def _said(features: Features) -> str:
    return " " + "".join(_kana(feature) for feature in features) + " "


def _frontend() -> Frontend:
    try:
        # It prints a warning of a package that it does without.
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            from pyopenjtalk import run_frontend
    except ImportError:
        message = "Japanese with kanji needs the extra 'ja': pip install 'risorius[ja]'; or write it in kana"
        raise SpeechError(message) from None
    return cast(Frontend, run_frontend)


def _pieces(written: str, features: Features, start: int) -> Iterator[ReadText]:
    """Yield what is said for each word, at its place; numbers are one word with what counts them."""
    plain = _plain(written)
    at, number = 0, 0
    while number < len(features) and at < len(plain):
        word = _plain(features[number]["string"])
        end, count = at + len(word), 1
        if not plain.startswith(word, at):
            end, count = _number(plain, at, features[number:])
        said = "".join(_kana(feature) for feature in features[number : number + count])
        joined = number > 0 and features[number]["chain_flag"] == 1
        if said:
            yield ("" if joined else " ") + said, start + at
        at, number = end, number + count


def _number(plain: str, at: int, features: Features) -> tuple[int, int]:
    """Return where a number in digits ends, with its counter, and how many words say it."""
    digits = _DIGITS.match(plain, at)
    end = digits.end() if digits else at + 1
    count = 0
    for feature in features:
        word = _plain(feature["string"])
        rest = word.lstrip(_NUMERALS)
        if count and (rest == word or not word) and plain.startswith(word, end):
            break
        count += 1
        if rest:
            return (end + len(rest) if plain.startswith(rest, end) else end), count
    return end, max(count, 1)


def _kana(feature: Mapping[str, Any]) -> str:
    said = "".join(char for char in str(feature["pron"]) if char not in _MARKS)
    return said if any(char.isalpha() for char in said) else ""


def _plain(text: str) -> str:
    """Return a text without forms of width, if it is as long."""
    plain = unicodedata.normalize("NFKC", text)
    return plain if len(plain) == len(text) else text
