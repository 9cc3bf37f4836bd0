"""Limits of a page's messages and requests."""

from __future__ import annotations

from .wire.tables import LimitsTable

# Characters of a script, and frames of a take: an hour at 60 a second.
SCRIPT = 200_000
FRAMES = 216_000
# Characters of a script that is performed in advance.
LONGEST_PREFETCH = 1_000
# Bytes of a recording, a project file, a message.
RECORDING = 100_000_000
PROJECT = 200_000_000
MESSAGE = 4_000_000
# Requests of one page at once, and events that wait for it; sessions open at once; takes that a session
# keeps; changes that can be undone; files that one export may write.
PENDING = 64
EVENTS = 256
SESSIONS = 32
TAKES = 6
UNDO = 200
EXPORTED = 40
# Edits in one change.
EDITS = 2_000


def described() -> LimitsTable:
    """Return the limits that a page should know."""
    return LimitsTable(SCRIPT, RECORDING, PROJECT, MESSAGE, PENDING, UNDO)
