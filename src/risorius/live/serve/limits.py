"""Limits of messages that a client may send and of frames that it may leave unread."""

from __future__ import annotations

CLIENTS = 16
"""Clients at once, unless told."""
# Bytes of a message; messages a second and at once; bytes a second and at once.
MESSAGE = 1_000_000
MESSAGES, MESSAGES_AT_ONCE = 100.0, 400.0
BYTES, BYTES_AT_ONCE = 1_000_000.0, 4_000_000.0
TEXT = 10_000
"""Characters of one message's text."""
# Seconds until the first message, and those in which a client may read nothing.
START, UNREAD = 10.0, 30.0
LATE = 0.25
"""Seconds after its time from which a frame is dropped; its sound is not."""
KEPT_SOUND = 2.0
"""Seconds of sound that are kept for a client that reads slowly."""
SEND_BUFFER = 65_536
"""Bytes that the system keeps for a client."""
EVENTS = 64
"""Events that wait for such a client; the oldest go."""
AHEAD = 2.0
"""Seconds by which a client may ask for its frames before they are due."""
TOKEN = 16
"""Characters that a token has at least."""
