"""The receiver of a stream: its protocol and address, or a handshake to wait for."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ...core.progress import Progress
from ...errors import InputError
from .handshake import wait_for_greeting
from .protocols import PROTOCOLS, Options, Protocol, check_options
from .receiver_socket import Address, check_host, parse_address

# Seconds to wait for a greeting.
PATIENCE = 60.0


@dataclass(frozen=True, slots=True)
class Receiver:
    """A protocol with its options, and the receiver's address; `listens`: the receiver greets there first."""

    protocol: Protocol
    options: Options
    address: Address
    listens: bool = False

    @classmethod
    def named(cls, protocol: str, to: str, listen: str | None, options: Options | None) -> Receiver:
        """Return the line to a receiver; raise InputError for an unknown option, OutputError for no host."""
        chosen, options = PROTOCOLS.get(protocol), options or Options()
        address = parse_address(listen or to, chosen.port)
        if listen is not None and not chosen.greetings:
            greeted = ", ".join(name for name in PROTOCOLS if PROTOCOLS.get(name).greetings)
            raise InputError(f"{protocol} has no greeting to wait for; expected --to, or one of {greeted}")
        check_options(protocol, options)
        if listen is None:
            check_host(address)
        return cls(chosen, options, address, listen is not None)

    def greeted(self, patience: float, progress: Progress) -> Receiver:
        """Wait for a handshake, if asked to, and return its sender; raise OutputError if none comes."""
        if not self.listens:
            return self
        progress(f"Waiting for a greeting at {self.address} …")
        host, greeting = wait_for_greeting(self.address, self.protocol.greetings, patience)
        protocol = PROTOCOLS.get(greeting.protocol)
        options = replace(self.options, dialect=greeting.dialect)
        return Receiver(protocol, options, Address(host, protocol.port))
