"""Sending: frames leave at their time by the clock; late ones are dropped, so that nothing drifts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from .clock import Clock
from .receiver_socket import Address, ReceiverSocket


@dataclass(frozen=True, slots=True)
class SendCounts:
    """The numbers of frames sent, and of frames dropped because their time had passed."""

    frames: int
    dropped: int


def send(
    packets: Callable[[int], Sequence[bytes]],
    frames: int,
    fps: Fraction,
    to: Address,
    clock: Clock,
    *,
    tcp: bool = False,
) -> SendCounts:
    """Send `frames` frames, by their index, at `fps` in real time, as datagrams or over `tcp`.

    A frame leaves when its time has come; one that is due while another is still being sent is dropped as
    soon as the next is due too. Raises OutputError for a host that is not known and a receiver that is not
    there or goes away.
    """
    sent, last = 0, -1
    with ReceiverSocket(to, tcp=tcp) as receiver, clock:
        while last < frames - 1:
            due = int(clock.now() * fps)
            if due <= last or due < 0:
                clock.sleep(float((last + 1) / fps) - clock.now())
                continue
            last = min(due, frames - 1)
            for packet in packets(last):
                receiver.send(packet)
            sent += 1
    return SendCounts(sent, frames - sent)
