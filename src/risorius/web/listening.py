"""Where a server listens."""

from __future__ import annotations

import socket

from ..errors import OutputError

HOST = "127.0.0.1"


def bound(port: int, host: str = HOST) -> socket.socket:
    """Return a socket that listens at `host` and `port` (0: any that is free); raise OutputError.

    Who comes before the server is ready waits.
    """
    made = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET, socket.SOCK_STREAM)
    made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        made.bind((host, port))
        made.listen()
    except OSError as error:
        made.close()
        reason = error.strerror or str(error)
        raise OutputError(f"port {port} cannot be used: {reason}; expected another --port") from None
    return made
