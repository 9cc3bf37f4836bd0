"""Plain text: one line to speak; words between asterisks are emphasised."""

from __future__ import annotations

import re

from ..core.directions import DirectedSpan, Directions, Emphasis
from ..errors import Place
from .model import Script, SpokenLine, script_of
from .speakable import check_speakable, position

# Asterisks around words, as in "I like *this* one"; not "2 * 3 * 4", nor "**".
_FOCUS = re.compile(r"(?<![\w*])\*([^\W_](?:[^*\n]*[\w.!?])?)\*(?![\w*])")


def parse_plain(text: str, source: str = "text") -> Script:
    """Return the script that speaks `text` as it stands; raise InputError if that cannot be spoken."""
    check_speakable(text, source)
    line = SpokenLine(text, None, Place(source, 1, 1), directions=read_focus(text, source))
    return script_of((line,), timed=False, source=source)


def read_focus(text: str, source: str) -> Directions:
    """Return the emphasis of the `*words*` of a text."""
    return Directions(
        tuple(
            DirectedSpan(m.start(1), m.end(1), position(source, text, m.start()), emphasis=Emphasis.MODERATE)
            for m in _FOCUS.finditer(text)
        )
    )
