"""`risorius stream`."""

from __future__ import annotations

from typing import Any

import click

from ..errors import InputError, UnreadError
from .console import Console
from .options import Command, displays, emotion_option, option, setting_options, settings_from


@click.command(cls=Command)
@click.argument("source", metavar="INPUT")
@option(
    "--protocol",
    group="Receiver",
    default="livelink",
    metavar="NAME",
    help="livelink, vmc, ifacialmocap or ifacialmocap-tcp.  [default: livelink]",
)
@option(
    "--to", group="Receiver", metavar="HOST[:PORT]", help="Address of the receiver.  [default: 127.0.0.1]"
)
@option(
    "--listen",
    group="Receiver",
    metavar="HOST[:PORT]",
    help="Wait here for a receiver's greeting, as of iFacialMocap, and send to that receiver.",
)
@option(
    "--patience",
    group="Receiver",
    type=click.FloatRange(0.0, min_open=True),
    default=60.0,
    metavar="S",
    help="How long to wait for a greeting.  [default: 60]",
)
@option(
    "--subject",
    group="Receiver",
    metavar="NAME",
    help="The name that the receiver shows (livelink).  [default: risorius]",
)
@option(
    "--names",
    group="Receiver",
    metavar="SET",
    help="Expressions over VMC: vrm0, vrm1, arkit or ARKit.  [default: vrm0]",
)
@option(
    "--without-sound",
    group="Receiver",
    is_flag=True,
    help="Do not play the voice; send by the machine's clock.",
)
@emotion_option
@setting_options(names=("fps", "head"))
def stream(
    source: str,
    protocol: str,
    to: str | None,
    listen: str | None,
    patience: float,
    subject: str | None,
    names: str | None,
    without_sound: bool,
    emotions: tuple[str, ...],
    **chosen: Any,
) -> None:
    """Perform INPUT for another program, live: the sound is the clock, late frames are dropped."""
    from ..api import speak as perform
    from ..stream import PATIENCE, PROTOCOLS, Options, check_options, parse_address, send_take

    stream_options = {"subject": subject, "names": names}
    options = Options(**{name: value for name, value in stream_options.items() if value is not None})
    check_options(protocol, options)
    if listen is None and patience != PATIENCE:
        raise UnreadError(["patience"], "nothing waits for a greeting; expected --listen as well")
    if to is not None and listen is not None:
        raise InputError("--to and --listen exclude each other; expected one of them")
    to = to or "127.0.0.1"
    parse_address(listen or to, PROTOCOLS.get(protocol).port)
    with Console() as console:
        settings = settings_from(chosen)
        take = perform(source, emotion=displays(emotions), settings=settings, progress=console.progress)
        sent = send_take(
            take,
            protocol,
            to,
            listen=listen,
            patience=patience,
            options=options,
            sound=not without_sound,
            progress=console.progress,
        )
        console.say(f"Sent {sent.frames} frames, dropped {sent.dropped}")
