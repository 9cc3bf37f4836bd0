"""Find the parts of a text that are said otherwise than written; tables are loaded only if needed."""

from __future__ import annotations

import re

from .abbreviations import Replacement
from .load import folder_of

_ANYTHING = re.compile(
    r"[\d@#~\u00b1\u00b2\u00b3\u00b9\u00bc-\u00be\u00d7\u00f7\u2030\u2044\u2070-\u2089\u2116\u2150-\u218f"
    r"\u2190-\u22ff\u27f5-\u27ff]|[<>=!-]=|[-=]>|\bwww\.|://|\b[IVXL]{2,}\b|\bw/| [<>] "
)
_HAN = re.compile("[\u3005-\u3007\u3400-\u4dbf\u4e00-\u9fff\U00020000-\U0003134f]")


def read_otherwise(text: str, code: str) -> tuple[Replacement, ...]:
    """Return the stretches of a text that a language (BCP 47) says otherwise than written, in order."""
    folder = folder_of(code)
    if folder == "ja" and _HAN.search(text):
        from .ja.kanji import kanji_readings

        return kanji_readings(text)
    if _ANYTHING.search(text) is None:
        return ()
    from .readings import readings_of

    return readings_of(folder).of(text, code.lower())
