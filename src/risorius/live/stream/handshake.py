"""Greetings: in some protocols the receiver speaks first, and the sender answers it."""

from __future__ import annotations

import socket
import time

from ...errors import InputError, OutputError
from .protocols import Asked, Greetings
from .receiver_socket import Address

_LARGEST = 2048  # bytes of a datagram that are read


def wait_for_greeting(at: Address, greetings: Greetings, seconds: float) -> tuple[str, Asked]:
    """Wait for a datagram that is one of `greetings`; return its sender and what it requests.

    Listens at `at` and ignores other datagrams. Raises InputError if `at` is not an address of this machine
    or is in use, OutputError if no greeting arrives within `seconds`.
    """
    end = time.monotonic() + seconds
    with _listening(at) as listener:
        while (left := end - time.monotonic()) > 0.0:
            listener.settimeout(left)
            try:
                data, sender = listener.recvfrom(_LARGEST)
            except TimeoutError:
                break
            except ConnectionResetError:  # some systems tell of an earlier answer that did not arrive
                continue
            greeting = greetings.get(data.strip(b"\0\r\n "))
            if greeting is not None:
                return str(sender[0]), greeting
    raise OutputError(f"no receiver sent its greeting to {at} within {seconds:g} s; expected one")


def _listening(at: Address) -> socket.socket:
    try:
        family, kind, protocol, _, place = socket.getaddrinfo(at.host, at.port, type=socket.SOCK_DGRAM)[0]
        listener = socket.socket(family, kind, protocol)
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"cannot listen at '{at}': {reason}") from None
    try:
        listener.bind(place)
    except OSError as error:
        listener.close()
        raise InputError(f"cannot listen at '{at}': {error.strerror}") from None
    return listener
