"""What a page may not exceed."""

from __future__ import annotations

# Characters of a script; bytes of an upload, of a message, of a request that is no upload.
SCRIPT = 200_000
RECORDING = 100_000_000
PROJECT = 200_000_000
MESSAGE = 4_000_000
# Requests of one page at once; sessions open at once; takes that a session keeps beside the one that is
# edited; changes that can be undone.
PENDING = 64
EVENTS = 256
SESSIONS = 32
TAKES = 6
UNDO = 200
# Seconds that a script may last, and files that one export may write.
LONGEST = 3600.0
EXPORTED = 40


def described() -> dict[str, float]:
    """Return the limits that a page should know."""
    return {
        "script": SCRIPT,
        "recording": RECORDING,
        "project": PROJECT,
        "message": MESSAGE,
        "pending": PENDING,
        "undo": UNDO,
    }
