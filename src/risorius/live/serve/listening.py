"""The address at which a server listens, and the bounds of what it accepts."""

from __future__ import annotations

import socket

import uvicorn
from starlette.types import ASGIApp

from ...errors import OutputError

HOST = "127.0.0.1"


def bound(port: int, host: str = HOST) -> socket.socket:
    """Return a socket that listens at `host` and `port` (0: any that is free); raise OutputError.

    Clients that come before the server is ready wait.
    """
    listener = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen()
    except OSError as error:
        listener.close()
        reason = error.strerror or str(error)
        raise OutputError(f"port {port} cannot be used: {reason}; expected another --port") from None
    return listener


def server_config(app: ASGIApp, largest: int) -> uvicorn.Config:
    """Return how uvicorn runs a server: messages of `largest` bytes at most, no access log.

    A WebSocket on which a text comes that is not UTF-8 is closed with 1007.
    """
    return uvicorn.Config(
        app,
        log_level="warning",
        access_log=False,
        ws="websockets-sansio",
        ws_max_size=largest,
        ws_per_message_deflate=False,
        timeout_graceful_shutdown=2,
        server_header=False,
        lifespan="on",
    )
