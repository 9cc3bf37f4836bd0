"""The command line: thin over the library, and the only place that exits."""

from __future__ import annotations

import errno
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from . import __version__
from .errors import InputError, OutputError, RisoriusError

if TYPE_CHECKING:
    from .channels import Display
    from .settings import Settings

DEFAULT_OUTPUT = "performance.mp4"
LONGEST_INPUT = 4_000_000
WITHOUT_SPEECH = ("curves", "vertices", "pixels", "head")
EXIT_FAULT, EXIT_INTERRUPTED = 2, 130

_CONTEXT = {"help_option_names": ["-h", "--help"], "max_content_width": 100}


def main() -> None:
    """Run the command line: exit code 0, or 2 with one line on what is wrong, or 130 when interrupted."""
    from .console import interrupt

    # Asked to end, we end as when interrupted: what is half-written goes.
    for asked in (signal.SIGINT, signal.SIGTERM):
        signal.signal(asked, interrupt)
    sys.exit(run(sys.argv[1:]))


def run(arguments: list[str]) -> int:
    """Run the command line with `arguments`; return the exit code."""
    try:
        commands.main(arguments, prog_name="risorius", standalone_mode=False)
    except click.exceptions.Exit as stop:
        return stop.exit_code
    except (click.Abort, KeyboardInterrupt):
        _say("risorius: interrupted; nothing was written")
        return EXIT_INTERRUPTED
    except click.ClickException as error:
        return _fault(error.format_message())
    except RisoriusError as error:
        return _fault(str(error))
    except BrokenPipeError:
        sys.stdout = None  # the reader has gone: nothing more can be said to it
        return 0
    except MemoryError:
        return _fault("out of memory; expected a smaller --size or a shorter text")
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        return _fault("no space left on the disk")
    return 0


def _fault(message: str) -> int:
    _say(f"risorius: {' '.join(message.split())}")
    return EXIT_FAULT


def _say(line: str) -> None:
    click.echo(line, err=True)


@click.group(context_settings=_CONTEXT)
@click.version_option(__version__, prog_name="risorius")
def commands() -> None:
    """Turn a script into a performing face.

    \b
    risorius speak "Hello there!" -o hello.mp4
    risorius speak "I told you so." --emotion anger:0.6 -o told.mp4
    risorius speak scene.xml -o scene.mp4 -o scene.muscles.csv
    risorius pose AU12=0.8 AU6=0.6 -o smile.png
    """


def _settings(**chosen: Any) -> Settings:
    from .core.performance import parse_fps
    from .core.score import BlendSettings
    from .settings import SPEAK_POLICY, Settings, parse_size

    blend = BlendSettings(
        conflict=chosen.pop("conflict", None) or SPEAK_POLICY,
        lips=chosen.pop("lips", None) or BlendSettings().lips,
        onset_function=chosen.pop("onset_function", None),
        contact=not chosen.pop("without_contact", False),
    )
    if (size := chosen.pop("size", None)) is not None:
        chosen["size"] = parse_size(size)
    if (fps := chosen.pop("fps", None)) is not None:
        chosen["fps"] = parse_fps(fps)
    return Settings(blend=blend, **{name: value for name, value in chosen.items() if value is not None})


_PICTURE_OPTIONS = (
    click.option("--size", metavar="WxH", help="Size of the picture in pixels.  [default: 720x720]"),
    click.option("--head", metavar="NAME", help="The head that performs.  [default: standard]"),
    click.option(
        "--age", type=float, metavar="YEARS", help="How old the head is, 0 to 100.  [default: its own age]"
    ),
)
_SKIN_OPTION = click.option(
    "--skin",
    "dynamics",
    metavar="NAME",
    help="How the skin moves: springs, biphasic or static.  [default: springs]",
)
_SAMPLING_OPTION = click.option(
    "--fps", metavar="RATE", help="Frames per second; fractions such as 24000/1001 work.  [default: 30]"
)
_OUTPUT_OPTION = click.option(
    "-o",
    "--output",
    "outputs",
    multiple=True,
    type=click.Path(path_type=Path, dir_okay=True),
    help="File to write; its suffix says what ('risorius list outputs'). May be given several times.",
)


def _picture_options(command: Any) -> Any:
    for option in reversed(_PICTURE_OPTIONS):
        command = option(command)
    return command


@commands.command()
@click.argument("source", metavar="INPUT")
@_OUTPUT_OPTION
@click.option("--text", "is_text", is_flag=True, help="INPUT is the text itself, whatever it looks like.")
@click.option(
    "--emotion",
    "emotions",
    multiple=True,
    metavar="NAME:INTENSITY[@START-END]",
    help="Show an emotion, 0 to 1, over the whole clip or a span in seconds. May be given several times.",
)
@click.option("--voice", metavar="NAME", help="The voice ('risorius list voices').  [default: en-us]")
@click.option("--rate", type=int, metavar="WPM", help="Words per minute, 80 to 440.")
@click.option("--lead", type=float, metavar="S", help="Silence before plain text.  [default: 0.5]")
@click.option("--tail", type=float, metavar="S", help="Silence after plain text.  [default: 0.7]")
@click.option("--articulation", type=float, metavar="X", help="How wide the mouth opens.  [default: 1]")
@click.option(
    "--without", multiple=True, metavar="CHANNEL", help="Leave a channel out ('risorius list channels')."
)
@click.option("--still", is_flag=True, help="No random blinks, head or eye movements.")
@click.option("--lips", metavar="MODEL", help="Coarticulation model.  [default: dominance]")
@click.option("--conflict", metavar="POLICY", help="What rival muscles do to each other.  [default: graded]")
@click.option("--without-contact", is_flag=True, help="Drop the lips' contact goals, to see what they do.")
@click.option("--onset-function", metavar="NAME", help="How all movements rise and fall.")
@_SAMPLING_OPTION
@_SKIN_OPTION
@click.option("--seed", type=int, metavar="N", help="Seed of everything random.  [default: 0]")
@_picture_options
@click.option("--at", type=float, metavar="S", help="Second that a .png shows.  [default: the middle]")
@click.option("--every", type=int, metavar="N", help="A .png is a sheet of every N-th frame.")
def speak(
    source: str,
    outputs: tuple[Path, ...],
    is_text: bool,
    emotions: tuple[str, ...],
    still: bool,
    **chosen: Any,
) -> None:
    """Perform INPUT: a text, a file (.txt, .xml, .score.json), or - for standard input."""
    settings = _settings(lively=not still, **chosen)
    targets = outputs or (Path(DEFAULT_OUTPUT),)
    from .console import Console

    with Console() as console:
        if not outputs:
            console.say(f"Writing {DEFAULT_OUTPUT} (choose with -o)")
        source, name = (source, "text") if source != "-" else (_standard_input(), "stdin")
        from .pipeline import check_outputs
        from .pipeline import speak as perform

        check_outputs(targets)
        take = perform(
            source,
            text=is_text or name == "stdin",
            source=name,
            emotion=_displays(emotions),
            settings=settings,
            progress=console.progress,
        )
        take.write(*targets, progress=console.progress)
        console.say(f"Wrote {', '.join(str(target) for target in targets)}")


def _standard_input() -> str:
    from .script.files import decode

    return decode(sys.stdin.buffer.read(LONGEST_INPUT), "stdin")


def _displays(emotions: tuple[str, ...]) -> tuple[Display, ...]:
    from .rules.emotions import parse_display

    return tuple(parse_display(text) for text in emotions)


@commands.command()
@click.argument("score", type=click.Path(path_type=Path, dir_okay=True))
@_OUTPUT_OPTION
@_SAMPLING_OPTION
@_SKIN_OPTION
@click.option("--conflict", metavar="POLICY", help="Override the score's conflict policy.")
@click.option("--onset-function", metavar="NAME", help="Override the movements' onset functions.")
@_picture_options
def mix(score: Path, outputs: tuple[Path, ...], **chosen: Any) -> None:
    """Combine the movements of SCORE (.json) into curves.

    Without -o the curves go to standard output as CSV.
    """
    from .pipeline import check_outputs
    from .pipeline import mix as combine

    check_outputs(outputs)
    shared = ("size", "head", "age", "fps", "dynamics")
    settings = _settings(**{name: value for name, value in chosen.items() if name in shared})
    take = combine(
        score, settings=settings, conflict=chosen["conflict"], onset_function=chosen["onset_function"]
    )
    if outputs:
        take.write(*outputs)
    else:
        from .out.muscles_csv import rows

        for row in rows(take.performance):
            click.echo(row)


@commands.command()
@click.argument("targets", nargs=-1, metavar="NAME=VALUE …")
@click.option("--emotion", "emotions", multiple=True, metavar="NAME:INTENSITY", help="Add an emotion.")
@_OUTPUT_OPTION
@_picture_options
def pose(
    targets: tuple[str, ...], emotions: tuple[str, ...], outputs: tuple[Path, ...], **chosen: Any
) -> None:
    """Draw one face: muscles, action units or other parameters, 0 to 1 (degrees for head and gaze).

    A name without .left or .right means both sides: risorius pose zygomatic_major=0.7 AU1=0.5 -o face.png
    """
    from .pipeline import check_outputs
    from .pipeline import pose as hold

    if not outputs:
        raise OutputError("no output named; expected -o face.png")
    check_outputs(outputs, WITHOUT_SPEECH)
    take = hold(_assignments(targets), emotion=_displays(emotions), settings=_settings(**chosen))
    take.write(*outputs)


@commands.command()
@click.argument("capture", type=click.Path(path_type=Path, dir_okay=True))
@click.option("--audio", metavar="WAV", help="A sound to go with it.")
@_OUTPUT_OPTION
@_SAMPLING_OPTION
@_SKIN_OPTION
@_picture_options
def play(capture: Path, audio: str | None, outputs: tuple[Path, ...], **chosen: Any) -> None:
    """Perform a captured face: CAPTURE is .arkit.csv, .au.csv, .fap, a score or a performance (.json).

    Any other .csv is read as a take of the Live Link Face app.
    """
    from .console import Console
    from .pipeline import check_outputs
    from .pipeline import play as perform

    if not outputs:
        raise OutputError("no output named; expected -o y.mp4")
    with Console() as console:
        check_outputs(outputs)
        take = perform(capture, audio=audio, settings=_settings(**chosen))
        take.write(*outputs, progress=console.progress)
        console.say(f"Wrote {', '.join(str(output) for output in outputs)}")


@commands.command()
@click.argument("source", metavar="INPUT")
@click.option("--protocol", default="livelink", metavar="NAME", help="livelink, vmc or ifacialmocap.")
@click.option("--to", default="127.0.0.1", metavar="HOST[:PORT]", help="Who receives it.")
@click.option("--subject", metavar="NAME", help="The name that the receiver shows.  [default: risorius]")
@click.option("--names", metavar="SET", help="Expressions over VMC: vrm0, vrm1, arkit or ARKit.")
@click.option("--without-sound", is_flag=True, help="Do not play the voice here; the machine's clock counts.")
@click.option("--emotion", "emotions", multiple=True, metavar="NAME:INTENSITY[@START-END]", help="Show one.")
@_SAMPLING_OPTION
@click.option("--head", metavar="NAME", help="The head that performs.  [default: standard]")
def stream(
    source: str,
    protocol: str,
    to: str,
    subject: str | None,
    names: str | None,
    without_sound: bool,
    emotions: tuple[str, ...],
    **chosen: Any,
) -> None:
    """Perform INPUT for another program, live: the sound is the clock, late frames are dropped."""
    from .console import Console
    from .pipeline import speak as perform
    from .pipeline import stream as send
    from .stream import PROTOCOLS, Options, parse_address

    given = {"subject": subject, "names": names}
    options = Options(**{name: value for name, value in given.items() if value is not None})
    parse_address(to, PROTOCOLS.get(protocol).port)
    with Console() as console:
        take = perform(
            source, emotion=_displays(emotions), settings=_settings(**chosen), progress=console.progress
        )
        sent = send(take, protocol, to, options=options, sound=not without_sound, progress=console.progress)
        console.say(f"Sent {sent.frames} frames, dropped {sent.dropped}")


@commands.command()
@click.argument("character", type=click.Path(path_type=Path, dir_okay=True))
@click.option(
    "--map", "map_file", type=click.Path(path_type=Path), help="TOML that says which target is which."
)
@click.option("--perform", metavar="INPUT", help="A text or file to perform on the character; needs -o.")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), help="The character's .glb with its animation."
)
@_SAMPLING_OPTION
@click.option("--head", metavar="NAME", help="The head that performs and measures.  [default: standard]")
def rig(
    character: Path, map_file: Path | None, perform: str | None, output: Path | None, **chosen: Any
) -> None:
    """Say what a CHARACTER of yours (.glb with blend shapes) can show; perform on it.

    Without --map the targets are guessed by name and shown as a table to correct: save it and give it back.
    """
    from .console import Console
    from .narration import tell_rig
    from .pipeline import rig as report
    from .pipeline import speak as speak_

    if (perform is None) != (output is None):
        raise InputError("--perform and -o go together; expected both or neither")
    settings = _settings(**chosen)
    with Console() as console:
        take = speak_(perform, settings=settings, progress=console.progress) if perform is not None else None
        found, rows = report(character, map_file=map_file, take=take, output=output, settings=settings)
        for line in tell_rig(found, rows, guessed=map_file is None):
            click.echo(line)


def _assignments(targets: tuple[str, ...]) -> dict[str, float]:
    found: dict[str, float] = {}
    for text in targets:
        name, equals, value = text.partition("=")
        try:
            if not equals:
                raise ValueError
            found[name] = float(value)
        except ValueError:
            raise InputError(f"'{text}' is not NAME=VALUE; expected e.g. zygomatic_major=0.7") from None
    return found


@commands.command()
@click.argument("performance", type=click.Path(path_type=Path, dir_okay=True))
@click.option(
    "--at", type=float, metavar="S", help="The second to explain; a summary of the clip without it."
)
@click.option("--parameter", metavar="NAME", help="One muscle or other parameter; all that move without it.")
def explain(performance: Path, at: float | None, parameter: str | None) -> None:
    """Say why the face does what it does, from a PERFORMANCE (.performance.json).

    Each value goes back to the movement that won and its cause in the script, and each loser has its reason.
    """
    from .core.parameters import parameters_named
    from .narration import narrate, tell
    from .pipeline import load

    if at is None and parameter is not None:
        raise InputError("--parameter needs a time; expected --at SECONDS as well")
    if parameter is not None:
        parameters_named(parameter)
    take = load(performance)
    lines = tell(take.summary()) if at is None else narrate(take.explain(at, parameter), at)
    for line in lines:
        click.echo(line)


@commands.command(name="list")
@click.argument("what", type=click.Choice(["muscles", "channels", "emotions", "voices", "outputs", "heads"]))
def list_(what: str) -> None:
    """List what can be named: muscles, channels, emotions, voices, outputs or heads."""
    from .console import table
    from .listing import LISTINGS

    header, rows = LISTINGS[what]()
    for line in table(header, rows):
        click.echo(line)
