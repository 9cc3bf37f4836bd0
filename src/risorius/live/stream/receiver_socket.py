"""The socket to a receiver: datagrams (UDP), or one stream of bytes (TCP)."""

from __future__ import annotations

import ipaddress
import re
import socket
from dataclasses import dataclass
from types import TracebackType
from typing import Any

from ...errors import InputError, OutputError

_PORT = re.compile(r"[0-9]{1,5}")
PATIENCE = 5.0  # s that a receiver may take to answer, or to read on


@dataclass(frozen=True, slots=True)
class Address:
    """The address at which a receiver listens."""

    host: str
    port: int

    def __str__(self) -> str:
        return f"{self.host}:{self.port}"


def parse_address(text: str, port: int) -> Address:
    """Return HOST or HOST:PORT as an address, by default at `port`; raise InputError for other text."""
    host, colon, number = text.strip().rpartition(":")
    if not colon or host.endswith(":"):
        host, number = text.strip(), str(port)
    host = host.removeprefix("[").removesuffix("]")
    if not _is_host(host) or not _PORT.fullmatch(number) or not 0 < int(number) < 65_536:
        raise InputError(f"'{text}' is not an address; expected HOST or HOST:PORT, e.g. 127.0.0.1:{port}")
    return Address(host, int(number))


def _is_host(text: str) -> bool:
    """Whether a text may name a host; with colons it is a number of IPv6 or none."""
    if ":" not in text:
        return bool(text)
    try:
        return bool(ipaddress.IPv6Address(text))
    except ValueError:
        return False


def check_host(to: Address) -> None:
    """Raise OutputError for a host that is not known."""
    _place_of(to, socket.SOCK_DGRAM)


class ReceiverSocket:
    """An open socket to a receiver, to be used in a `with` block.

    Raises OutputError for a host that is not known, a receiver that is not there, and one that goes away.
    """

    def __init__(self, to: Address, *, tcp: bool = False) -> None:
        self._to = to
        family, place = _place_of(to, kind := socket.SOCK_STREAM if tcp else socket.SOCK_DGRAM)
        self._socket = socket.socket(family, kind)
        try:
            self._socket.settimeout(PATIENCE)
            self._socket.connect(place)
            if tcp:  # a frame that waits for the next to fill a packet comes late
                self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        except OSError as error:
            self._socket.close()
            raise _fault(to, error) from None

    def send(self, packet: bytes) -> None:
        """Send a datagram, or a piece of the stream."""
        try:
            self._socket.sendall(packet)
        except OSError as error:
            raise _fault(self._to, error) from None

    def __enter__(self) -> ReceiverSocket:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._socket.close()


def _place_of(to: Address, kind: socket.SocketKind) -> tuple[socket.AddressFamily, Any]:
    """Return the family of a host's address, and the address as sockets take it."""
    try:
        family, _, _, _, place = socket.getaddrinfo(to.host, to.port, type=kind)[0]
    except (OSError, UnicodeError) as error:
        raise _fault(to, error) from None
    return family, place


def _fault(to: Address, error: OSError | UnicodeError) -> OutputError:
    if isinstance(error, ConnectionRefusedError):
        return OutputError(f"nothing listens at {to}; expected a receiver that is running")
    if isinstance(error, BrokenPipeError | ConnectionResetError):
        return OutputError(f"the receiver at {to} has closed the connection")
    if isinstance(error, TimeoutError):
        return OutputError(f"'{to}' has not answered for {PATIENCE:g} s; expected a receiver")
    return OutputError(f"'{to}' cannot be reached: {getattr(error, 'strerror', None) or error}")
