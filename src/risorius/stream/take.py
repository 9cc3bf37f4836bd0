"""A take sent to another program: who receives it and by which protocol, its sound as the clock."""

from __future__ import annotations

from dataclasses import replace

from ..core.progress import Progress, quiet
from ..errors import InputError
from ..take import Take
from . import clock
from .greeting import wait_for_greeting
from .protocols import PROTOCOLS, Options, check_options
from .receiver_socket import Address, check_host, parse_address
from .send import SendCounts, send

# Seconds to wait for a greeting.
PATIENCE = 60.0


def send_take(
    take: Take,
    protocol: str,
    to: str = "127.0.0.1",
    *,
    listen: str | None = None,
    patience: float = PATIENCE,
    options: Options | None = None,
    sound: bool = False,
    progress: Progress = quiet,
) -> SendCounts:
    """Send a take to another program in real time; return how many frames were sent and dropped.

    `protocol` is livelink, vmc, ifacialmocap or ifacialmocap-tcp, `to` HOST or HOST:PORT. With `listen`, HOST
    or HOST:PORT of this machine, it is sent to who greets there within `patience` seconds, as receivers of
    iFacialMocap do, by datagrams or TCP as they ask.
    With `sound` the voice is played here and is the clock. Raises InputError for a wrong protocol or address,
    OutputError where nothing listens or nobody greets.
    """
    chosen = PROTOCOLS.get(protocol)
    options = options or Options()
    address = parse_address(listen or to, chosen.port)
    if listen is not None and not chosen.greetings:
        greeted = ", ".join(name for name in PROTOCOLS if PROTOCOLS.get(name).greetings)
        raise InputError(f"{protocol} has no greeting to wait for; expected --to, or one of {greeted}")
    check_options(protocol, options)
    if listen is None:
        check_host(address)
    timer = clock.SoundClock(take.audio) if sound and take.audio is not None else clock.MachineClock()
    progress("Fitting weights …")
    track = take.arkit
    if listen is not None:
        progress(f"Waiting for a greeting at {address} …")
        host, greeting = wait_for_greeting(address, chosen.greetings, patience)
        chosen, options = PROTOCOLS.get(greeting.protocol), replace(options, dialect=greeting.dialect)
        address = Address(host, chosen.port)
    packets = chosen.make(track, take.performance.fps, options)
    progress(f"Sending to {address} …")
    frames, fps = len(take.performance.values), take.performance.fps
    return send(packets, frames, fps, address, timer, tcp=chosen.tcp)
