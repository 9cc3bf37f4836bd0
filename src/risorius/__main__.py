"""The command `risorius`, and `python -m risorius`: the command line, which also ends well while it loads."""

from __future__ import annotations

import os
import signal
import sys
from types import FrameType

_INTERRUPTED = 130  # the exit code of a program that was asked to end
_SAID = b"risorius: interrupted; nothing was written\n"
_SAID_IN_JSON = b'{"error": "interrupted; nothing was written"}\n'


def main() -> None:
    """Load the command line and run it."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _end)
    from .cli import main as run

    run()


def _end(number: int, frame: FrameType | None) -> None:
    """Handle a signal that comes while modules load: nothing is begun yet, so nothing has to be undone."""
    os.write(2, _SAID_IN_JSON if "--json" in sys.argv else _SAID)
    os._exit(_INTERRUPTED)


if __name__ == "__main__":
    main()
