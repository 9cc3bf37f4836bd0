"""Receivers that speak first: a protocol whose sender waits for a greeting, and answers who sent it."""

from __future__ import annotations

import socket
import time

from ..errors import InputError, OutputError
from .line import Address
from .protocols import Asked, Greetings

_LARGEST = 2048  # bytes of a greeting that are looked at


def wait_for_greeting(at: Address, greetings: Greetings, seconds: float) -> tuple[str, Asked]:
    """Wait for a datagram that is one of `greetings`; return who said it, and what they ask for.

    Listens at `at`. What is no greeting is passed over. Raises InputError where `at` is no place of this
    machine or taken, OutputError where nobody has greeted within `seconds`.
    """
    end = time.monotonic() + seconds
    with _listening(at) as line:
        while (left := end - time.monotonic()) > 0.0:
            line.settimeout(left)
            try:
                data, who = line.recvfrom(_LARGEST)
            except TimeoutError:
                break
            except ConnectionResetError:  # some systems tell of an earlier answer that did not arrive
                continue
            asked = greetings.get(data.strip(b"\0\r\n "))
            if asked is not None:
                return str(who[0]), asked
    raise OutputError(f"no receiver has sent its greeting to {at} within {seconds:g} s; expected one")


def _listening(at: Address) -> socket.socket:
    try:
        family, kind, protocol, _, place = socket.getaddrinfo(at.host, at.port, type=socket.SOCK_DGRAM)[0]
        line = socket.socket(family, kind, protocol)
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"cannot listen at '{at}': {reason}") from None
    try:
        line.bind(place)
    except OSError as error:
        line.close()
        raise InputError(f"cannot listen at '{at}': {error.strerror}") from None
    return line
