"""Sending: frames leave at their time by the clock; what would be late is dropped, so that nothing drifts."""

from __future__ import annotations

import socket
from dataclasses import dataclass
from fractions import Fraction

from ..errors import InputError, OutputError
from .clock import Clock
from .protocols import Packets


@dataclass(frozen=True, slots=True)
class Address:
    """Where a receiver listens."""

    host: str
    port: int

    def __str__(self) -> str:
        return f"{self.host}:{self.port}"


@dataclass(frozen=True, slots=True)
class Sent:
    """How many frames were sent, and how many were dropped because their time had passed."""

    frames: int
    dropped: int


def parse_address(text: str, port: int) -> Address:
    """Return HOST or HOST:PORT as an address, by default at `port`; raise InputError if it is none."""
    host, colon, number = text.strip().rpartition(":")
    if not colon or host.endswith(":"):
        host, number = text.strip(), str(port)
    host = host.removeprefix("[").removesuffix("]")
    if not host or not number.isdecimal() or not 0 < int(number) < 65_536:
        raise InputError(f"'{text}' is no address; expected HOST or HOST:PORT, e.g. 127.0.0.1:{port}")
    return Address(host, int(number))


def send(packets: Packets, frames: int, fps: Fraction, to: Address, clock: Clock) -> Sent:
    """Send `frames` frames at `fps` in real time.

    A frame leaves when its time has come; one that is due while another is still being sent is dropped as
    soon as the next is due too. Raises OutputError for a host that is not known and a receiver that is not
    there.
    """
    sent, last = 0, -1
    with _connected(to) as line, clock:
        while last < frames - 1:
            due = int(clock.now() * fps)
            if due <= last or due < 0:
                clock.sleep(float((last + 1) / fps) - clock.now())
                continue
            last = min(due, frames - 1)
            for packet in packets(last):
                _send(line, packet, to)
            sent += 1
    return Sent(sent, frames - sent)


def _connected(to: Address) -> socket.socket:
    try:
        family, kind, protocol, _, place = socket.getaddrinfo(to.host, to.port, type=socket.SOCK_DGRAM)[0]
        line = socket.socket(family, kind, protocol)
        line.connect(place)
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise OutputError(f"'{to}' cannot be reached: {reason}") from None
    return line


def _send(line: socket.socket, packet: bytes, to: Address) -> None:
    try:
        line.send(packet)
    except ConnectionRefusedError:
        raise OutputError(f"nothing listens at {to}; expected a receiver that is running") from None
    except OSError as error:
        raise OutputError(f"'{to}' cannot be reached: {error.strerror}") from None
