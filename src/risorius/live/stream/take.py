"""A take sent to another program: its receiver and protocol, with the sound as the clock."""

from __future__ import annotations

from collections.abc import Sequence

from ...core.lips.closed_lips import shut_lips
from ...core.progress import Progress, quiet
from ...face.fit.expressions import emotion_weights
from ...take import Take
from . import clock
from .protocols import ArkitMoment, Options
from .receiver import PATIENCE, Receiver
from .send import SendCounts, send


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
    or HOST:PORT of this machine, wait `patience` seconds there for a handshake, which receivers of
    iFacialMocap send, and send the take to its sender, by datagrams or TCP as it asks.
    With `sound` the voice is played here and is the clock. Raises InputError for a wrong protocol or address,
    OutputError if nothing listens or no handshake comes.
    """
    line = Receiver.named(protocol, to, listen, options)
    timer = clock.SoundClock(take.audio) if sound and take.audio is not None else clock.MachineClock()
    progress("Fitting weights …")
    track = take.arkit
    line = line.greeted(patience, progress)
    frames, fps = len(take.performance.values), take.performance.fps
    packets = line.protocol.make(fps, line.options)

    shut = shut_lips(take.head_lips, take.performance.values).tolist()
    emotion = emotion_weights(take.emotion_curves())

    def packets_of(index: int) -> Sequence[bytes]:
        turns = track.head[index], track.eyes[index]
        return packets(ArkitMoment(index, track.weights[index], *turns, shut[index], emotion[index]))

    progress(f"Sending to {line.address} …")
    return send(packets_of, frames, fps, line.address, timer, tcp=line.protocol.tcp)
