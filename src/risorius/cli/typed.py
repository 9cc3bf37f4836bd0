"""Standard input that is said as it comes."""

from __future__ import annotations

import codecs
import sys
import threading
import time
from typing import TYPE_CHECKING

from ..errors import InputError, Place, RisoriusError, UnreadError

if TYPE_CHECKING:
    from ..live.session import Live
    from ..rules.emotions import Displays
    from ..settings import Settings

_PIECE = 65_536
# Sentences that wait, beyond which no more are read, and seconds until that is seen again.
_MOST, _PAUSE = 100, 0.1


def face_of(settings: Settings, emotions: Displays) -> Live:
    """Return a live face that feels emotions; raise RisoriusError for any that it cannot feel."""
    from ..live.session import Live

    face = Live(settings, arkit=True)
    for display in emotions:
        if (display.start, display.end, display.priority) != (None, None, None):
            raise UnreadError(
                ["emotion"], "text that is still being written has no times; expected NAME:INTENSITY"
            )
        face.feel(display.emotion, display.intensity)
    return face


class TypedText:
    """Reads standard input in a thread, and lets a face say it; at its end the face is closed."""

    def __init__(self, face: Live) -> None:
        """Raise InputError if standard input is closed."""
        if sys.stdin is None:
            raise InputError("standard input is closed; expected a text on it")
        self._face = face
        self._fault: RisoriusError | None = None
        self._is_empty = True
        # The program may end while it waits.
        threading.Thread(target=self._read, daemon=True).start()

    def check(self) -> None:
        """Raise the error that reading the text gave; InputError if the text is empty."""
        if self._fault is not None:
            raise self._fault
        if self._is_empty:
            raise InputError("is empty; expected a text", Place("stdin"))

    def _read(self) -> None:
        decoder = codecs.getincrementaldecoder("utf-8-sig")()
        source = sys.stdin.buffer
        read = getattr(source, "read1", source.read)
        try:
            while piece := read(_PIECE):
                while self._face.waiting > _MOST:
                    time.sleep(_PAUSE)
                self._say(decoder.decode(piece))
            decoder.decode(b"", final=True)
        except UnicodeDecodeError:
            self._fault = InputError("is not UTF-8; expected a text", Place("stdin"))
        except RisoriusError as error:
            self._fault = error
        self._face.close()

    def _say(self, text: str) -> None:
        self._is_empty = self._is_empty and not text.strip()
        self._face.say(text)
