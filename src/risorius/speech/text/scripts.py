"""Words in the script of another language, which a voice would spell ("chinese letter"): who reads them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple


class ScriptSpan(NamedTuple):
    """Characters [start, end) of a text, and the language (BCP 47) that reads their script, "" for none."""

    start: int
    end: int
    language: str


# Scripts that one language stands for, and the languages that are written in them.
_HAN, _KANA, _HANGUL, _CYRILLIC = "cmn", "ja", "ko", "ru"
_UNREAD = "unread"
_SCRIPTS = {
    _HAN: "\u3005-\u3007\u3400-\u4dbf\u4e00-\u9fff",
    _KANA: "\u3041-\u309f\u30a1-\u30fa\u30fc-\u30ff",
    _HANGUL: "\u1100-\u11ff\uac00-\ud7a3",
    _CYRILLIC: "\u0400-\u052f",
    "el": "\u0370-\u03ff\u1f00-\u1fff",
    "ar": "\u0620-\u065f\u066e-\u06d3",
    "he": "\u05d0-\u05ea",
    "hi": "\u0900-\u097f",
    # Scripts of which voices of other languages spell every character: of India, Thai to Khmer, old ones.
    _UNREAD: (
        "\u0980-\u0dff\u0e01-\u0eff\u0f40-\u109f\u1200-\u139f\u1680-\u16ff\u1780-\u17d3\U00010000-\U0001d3ff"
    ),
}
_ANY = re.compile(f"[{''.join(_SCRIPTS.values())}]")
_RUNS = re.compile("|".join(f"(?P<{code}>[{chars}]+)" for code, chars in _SCRIPTS.items()))
# Languages whose voices spell other scripts, and those that they read.
_LATIN = """
en de fr es it pt nl pl vi sv da nb no fi cs sk hu ro tr id ca et lv lt hr sl eo la eu gl cy ga is af sw ms
"""
_READ: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(_LATIN.split(), ()),
    **dict.fromkeys(("cmn", "yue", "hak", "nan"), (_HAN,)),
    **dict.fromkeys(("ru", "uk", "bg"), (_CYRILLIC,)),
    "ja": (_HAN, _KANA),
    "ko": (_HANGUL,),
    "hi": ("hi",),
}


def foreign_scripts(text: str, code: str) -> Iterator[ScriptSpan]:
    """Yield the words of a text in scripts that a language (BCP 47) does not read; single Greek letters are
    left to it. Chinese characters beside kana are Japanese.
    """
    if _ANY.search(text) is None:
        return
    own = _READ.get(code.lower().split("-")[0])
    if own is None:
        return
    has_kana = any(match.lastgroup == _KANA for match in _RUNS.finditer(text))
    last: ScriptSpan | None = None
    for match in _RUNS.finditer(text):
        script = str(match.lastgroup)
        if script in own or (script == "el" and len(match[0]) == 1):
            continue
        script = "" if script == _UNREAD else script
        language = _KANA if script == _HAN and has_kana and _HAN not in own else script
        if last is not None and last.end == match.start() and last.language == language:
            last = last._replace(end=match.end())
            continue
        if last is not None:
            yield last
        last = ScriptSpan(match.start(), match.end(), language)
    if last is not None:
        yield last
