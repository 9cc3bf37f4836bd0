"""Plain text: one line to speak, nothing marked."""

from __future__ import annotations

from ..errors import Place
from .model import Script, SpokenLine, script_of
from .speakable import check_speakable


def parse_plain(text: str, source: str = "text") -> Script:
    """Return the script that speaks `text` as it stands; raise InputError if that cannot be spoken."""
    check_speakable(text, source)
    return script_of((SpokenLine(text, None, Place(source, 1, 1)),), timed=False, source=source)
