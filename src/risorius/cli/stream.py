"""`risorius stream`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..core.names import Names
from ..errors import InputError, UnusedSettingError
from ..settings.declare import Stage
from .console import Console
from .inputs import Spoken, input_options
from .options import (
    Command,
    Named,
    NumberIn,
    check_outputs,
    option,
    setting_options,
    settings_from,
)
from .typed import TypedText, face_of

# The stream sends weights, as an ARKit CSV has them: they depend on all that curves and skin depend on.
_LIKE = Path("x.arkit.csv")
_READ = (Stage.VOICE, Stage.PLAN, Stage.COMBINE, Stage.FRAMES, Stage.HEAD, Stage.SHAPE, Stage.SKIN)


@click.command(cls=Command, short_help="Send a performance to Unreal, VRM avatars and others, live.")
@click.argument("source", metavar="[INPUT]", required=False)
@option(
    "--protocol",
    group="Receiver",
    default="livelink",
    metavar="NAME",
    type=Named(Names(path="live.stream:PROTOCOLS")),
    help="livelink, vmc, ifacialmocap or ifacialmocap-tcp.  [default: livelink]",
)
@option(
    "--to", group="Receiver", metavar="HOST[:PORT]", help="Address of the receiver.  [default: 127.0.0.1]"
)
@option(
    "--listen",
    group="Receiver",
    metavar="HOST[:PORT]",
    help="Wait at this address for the greeting of a receiver (iFacialMocap), and send to it.",
)
@option(
    "--patience",
    group="Receiver",
    type=NumberIn(0.001, kind=float),
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
    type=Named(Names(path="live.stream.protocols:NAMES")),
    help="Expressions over VMC: vrm0, vrm1, arkit or ARKit.  [default: vrm0]",
)
@option(
    "--without-sound",
    group="Receiver",
    is_flag=True,
    help="Do not play the voice; send by the machine's clock.",
)
@input_options
@setting_options(_READ)
def stream(
    source: str | None,
    protocol: str,
    to: str | None,
    listen: str | None,
    patience: float,
    subject: str | None,
    names: str | None,
    without_sound: bool,
    is_text: bool,
    emotions: tuple[str, ...],
    audio: str | None,
    transcript: str | None,
    **chosen: Any,
) -> None:
    """Perform INPUT (a text, a file, or - for standard input) for another program, live.

    The sound is the clock; late frames are dropped. With --audio a recorded voice is performed, as in
    `speak`. Standard input is said sentence by sentence as it comes, until it ends.
    """
    from ..api import displays_of
    from ..live.stream import PATIENCE, PROTOCOLS, Options, check_options, parse_address, send_live, send_take

    spoken = Spoken(source, is_text, emotions, audio, transcript)
    stream_options = {"subject": subject, "names": names}
    options = Options(**{name: value for name, value in stream_options.items() if value is not None})
    check_options(protocol, options)
    if listen is None and patience != PATIENCE:
        raise UnusedSettingError(["patience"], "only --listen waits for a greeting; expected it as well")
    if to is not None and listen is not None:
        raise InputError("--to and --listen exclude each other; expected one of them")
    to = to or "127.0.0.1"
    parse_address(listen or to, PROTOCOLS.get(protocol).port)
    line: dict[str, Any] = {"listen": listen, "patience": patience, "options": options}
    with Console() as console:
        settings = settings_from(chosen)
        check_outputs([_LIKE], settings)
        line |= {"sound": not without_sound, "progress": console.progress}
        if source == "-" and audio is None and transcript is None:
            face = face_of(settings, displays_of(emotions, settings))
            typed = TypedText(face)
            sent = send_live(face, protocol, to, **line)
            typed.check()
        else:
            sent = send_take(spoken.perform(settings, console.progress), protocol, to, **line)
        console.say(f"Sent {sent.frames} frames, dropped {sent.dropped}")
