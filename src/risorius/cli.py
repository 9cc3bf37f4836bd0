"""The command line: thin over the library, and the only place that exits."""

from __future__ import annotations

import atexit
import errno
import os
import signal
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from . import __version__
from .errors import InputError, OutputError, RisoriusError, UnreadError

if TYPE_CHECKING:
    from .channels import Display
    from .core.look import Look
    from .settings import Settings

DEFAULT_OUTPUT = "performance.mp4"
LONGEST_INPUT = 4_000_000
WITHOUT_SPEECH = ("curves", "vertices", "pixels", "head")
EXIT_FAULT, EXIT_INTERRUPTED = 2, 130

_LISTED = (
    "muscles",
    "channels",
    "emotions",
    "profiles",
    "attitudes",
    "voices",
    "outputs",
    "heads",
    "sliders",
)
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
    except UnreadError as error:
        return _fault(str(error.spelled(_flag)))
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


def leave() -> None:
    """End the process at once, with exit code 0, after what it has put off to its end.

    Threads may be at work in a compiler written in C++: as they stood when a process ended the usual way,
    which destroys what they work with, they would abort it.
    """
    atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


def _flag(name: str) -> str:
    """Return the option that gives a setting."""
    flags = {"dynamics": "skin", "lively": "still", "attitudes": "attitude", "contact": "without-contact"}
    return f"--{flags.get(name, name).replace('_', '-')}"


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
    from .settings import BlendChoices, Settings, parse_size

    blend = BlendChoices(
        conflict=chosen.pop("conflict", None),
        lips=chosen.pop("lips", None),
        onset_function=chosen.pop("onset_function", None),
        contact=False if chosen.pop("without_contact", False) else None,
    )
    look = _look(chosen)
    if (size := chosen.pop("size", None)) is not None:
        chosen["size"] = parse_size(size)
    if shape := chosen.pop("shape", None):
        from .face.sliders import parse_slider

        chosen["shape"] = dict(parse_slider(text) for text in shape)
    chosen["voice_emotion"] = chosen.pop("voice_emotion", None) != "off"
    if (fps := chosen.pop("fps", None)) is not None:
        chosen["fps"] = parse_fps(fps)
    return Settings(
        blend=blend, look=look, **{name: value for name, value in chosen.items() if value is not None}
    )


def _look(chosen: dict[str, Any]) -> Look:
    """Take the choices of `_PICTURE_OPTIONS` that say how a head is drawn out of `chosen`."""
    from .core.look import Look, parse_camera, parse_complexion, parse_overlay

    given = {name: chosen.pop(name, None) for name in _LOOK_OPTIONS}
    if given["camera"] is not None:
        given["camera"], given["lens"] = parse_camera(given["camera"])
    if given["complexion"] is not None:
        given["complexion"] = parse_complexion(given["complexion"])
    if given["overlay"] is not None:
        given["overlay"] = parse_overlay(given["overlay"])
    return Look(**{name: value for name, value in given.items() if value is not None})


_LOOK_OPTIONS = ("style", "camera", "light", "background", "quality", "hair", "complexion", "overlay")
_PICTURE_OPTIONS = (
    click.option("--size", metavar="WxH", help="Size of the picture in pixels.  [default: 720x720]"),
    click.option("--head", metavar="NAME", help="The head that performs.  [default: standard]"),
    click.option(
        "--age", type=float, metavar="YEARS", help="How old the head is, 0 to 100.  [default: its own age]"
    ),
    click.option(
        "--shape",
        multiple=True,
        metavar="NAME:VALUE",
        help="A slider of the head's shape, -1 to 1, e.g. nose_width:0.5; may be repeated. "
        "`list sliders` names them.",
    ),
    click.option("--style", metavar="NAME", help="realistic, clay, muscles or wireframe."),
    click.option(
        "--camera",
        metavar="NAME[:MM]",
        help="portrait, close-up, eyes, mouth, three-quarter or profile; lens.  [default: portrait:85]",
    ),
    click.option("--light", metavar="NAME", help="studio, daylight or dark.  [default: studio]"),
    click.option(
        "--background", metavar="WHAT", help="A colour, a picture, or 'transparent' (.png, .webm, .mov)."
    ),
    click.option("--quality", metavar="NAME", help="draft, normal or high.  [default: normal]"),
    click.option("--hair", metavar="NAME", help="short, medium, shaved or bald.  [default: the head's own]"),
    click.option(
        "--complexion",
        metavar="NAME",
        help="fair, light, tan, brown, dark, or 0 to 1.  [default: the head's own]",
    ),
    click.option(
        "--overlay", metavar="NAME,…", help="What explains the picture: caption, phones, bars, lanes."
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


_AT_OPTION = click.option(
    "--at", type=float, metavar="S", help="Second that a .png shows.  [default: the middle]"
)
_EVERY_OPTION = click.option("--every", type=int, metavar="N", help="A .png is a sheet of every N-th frame.")
_RULES_OPTION = click.option(
    "--rules",
    metavar="FILE",
    type=click.Path(path_type=Path, dir_okay=True),
    help="A file of rules that adds to ours, replaces or deletes them.",
)


def _picture_options(command: Any) -> Any:
    for option in reversed(_PICTURE_OPTIONS):
        command = option(command)
    return command


_TRANSCRIPT_HELP = "What the recording says, or a file with it."


@commands.command()
@click.argument("source", metavar="[INPUT]", required=False)
@_OUTPUT_OPTION
@click.option("--text", "is_text", is_flag=True, help="INPUT is the text itself, whatever it looks like.")
@click.option(
    "--emotion",
    "emotions",
    multiple=True,
    metavar="NAME:INTENSITY[@START-END]",
    help="Show an emotion, 0 to 1, over the whole clip or a span in seconds. May be given several times.",
)
@click.option("--profile", metavar="NAME", help="Who speaks: a profile, or a .toml file.  [default: neutral]")
@click.option(
    "--attitude",
    "attitudes",
    multiple=True,
    metavar="NAME",
    help="What the speaker wants to convey, over the profile. May be given several times.",
)
@_RULES_OPTION
@click.option("--audio", metavar="FILE", help="A recorded voice: WAV, FLAC, OGG or MP3.")
@click.option("--transcript", metavar="TEXT|FILE", help=f"{_TRANSCRIPT_HELP}  [default: INPUT]")
@click.option(
    "--voice", metavar="NAME", help="The voice ('risorius list voices'), or its file.  [default: en-us]"
)
@click.option("--language", metavar="CODE", help="Speak a language with its first voice: de, fr, cmn …")
@click.option("--rate", type=int, metavar="WPM", help="Words per minute, 80 to 440.")
@click.option(
    "--voice-emotion",
    type=click.Choice(["on", "off"]),
    help="Whether emotions change the voice.  [default: on]",
)
@click.option("--lead", type=float, metavar="S", help="Silence before plain text.  [default: 0.5]")
@click.option("--tail", type=float, metavar="S", help="Silence after plain text.  [default: 0.7]")
@click.option("--articulation", type=float, metavar="X", help="How far the lips move.  [default: 1]")
@click.option("--manner", metavar="NAME", help="Manner of speech: whisper, murmur or shout.")
@click.option(
    "--without", multiple=True, metavar="CHANNEL", help="Leave a channel out ('risorius list channels')."
)
@click.option("--still", is_flag=True, help="Only what is said and marked: no rules, nothing random.")
@click.option("--lips", metavar="MODEL", help="Coarticulation model.  [default: dominance]")
@click.option("--conflict", metavar="POLICY", help="What rival muscles do to each other.  [default: graded]")
@click.option("--without-contact", is_flag=True, help="Drop the lips' contact goals, to see what they do.")
@click.option("--onset-function", metavar="NAME", help="How all movements rise and fall.")
@_SAMPLING_OPTION
@_SKIN_OPTION
@click.option("--seed", type=int, metavar="N", help="Seed of everything random.  [default: 0]")
@_picture_options
@_AT_OPTION
@_EVERY_OPTION
def speak(
    source: str | None,
    outputs: tuple[Path, ...],
    is_text: bool,
    emotions: tuple[str, ...],
    still: bool,
    audio: str | None,
    transcript: str | None,
    **chosen: Any,
) -> None:
    """Perform INPUT: a text, a file, or - for standard input.

    Files: .txt, .xml, .utt, .ssml, .bml, .TextGrid, .score.json.

    With --audio a recorded voice is performed. It says INPUT or the transcript, or is labelled by INPUT (a
    .TextGrid); without these its words are guessed.
    """
    if source is None and audio is None:
        raise InputError("nothing to perform; expected a text, a file or --audio")
    if source is None and is_text:
        raise UnreadError(["text"], "there is no INPUT; expected one, or --transcript TEXT")
    settings = _settings(lively=not still, **chosen)
    targets = outputs or (Path(DEFAULT_OUTPUT),)
    from .console import Console

    with Console() as console:
        if not outputs:
            console.say(f"Writing {DEFAULT_OUTPUT} (choose with -o)")
        source, name = (source, "text") if source != "-" else (_standard_input(), "stdin")
        from .api import speak as perform
        from .ports.targets import check_targets as check_outputs

        check_outputs(targets, alpha=settings.look.transparent)
        take = perform(
            source,
            audio=audio,
            transcript=transcript,
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
@click.argument("audio")
@click.argument("transcript", required=False)
@_OUTPUT_OPTION
def align(audio: str, transcript: str | None, outputs: tuple[Path, ...]) -> None:
    """Say when each word and phone of TRANSCRIPT (a text or a file with it) is spoken in AUDIO.

    Correct the TextGrid in Praat, then perform it: risorius speak x.TextGrid --audio x.wav. Without a
    TRANSCRIPT the words are guessed.
    """
    from .console import Console

    with Console() as console:
        from .api import align as find
        from .ports.targets import check_targets as check_outputs
        from .speech.prosody import speech_rate

        if not outputs:
            raise OutputError("no output named; expected -o x.TextGrid")
        check_outputs(outputs, ("speech",))
        take = find(audio, transcript, progress=console.progress)
        take.write(*outputs)
        if said := take.utterance:
            console.say(f"{len(said.words)} words, {speech_rate(said):.1f} syllables per second of speech")
        console.say(f"Wrote {', '.join(str(output) for output in outputs)}")


@commands.command()
@click.argument("score", type=click.Path(path_type=Path, dir_okay=True))
@_OUTPUT_OPTION
@_SAMPLING_OPTION
@_SKIN_OPTION
@click.option("--conflict", metavar="POLICY", help="Override the score's conflict policy.")
@click.option("--onset-function", metavar="NAME", help="Override the movements' onset functions.")
@_picture_options
@_AT_OPTION
@_EVERY_OPTION
def mix(score: Path, outputs: tuple[Path, ...], **chosen: Any) -> None:
    """Combine the movements of SCORE (.json) into curves.

    Without -o the curves go to standard output as CSV.
    """
    from .api import mix as combine
    from .ports.targets import check_targets as check_outputs

    settings = _settings(**chosen)
    check_outputs(outputs, alpha=settings.look.transparent)
    take = combine(score, settings=settings)
    if outputs:
        take.write(*outputs)
    else:
        from .ports.muscles_csv import rows

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
    from .api import pose as hold
    from .ports.targets import check_targets as check_outputs

    if not outputs:
        raise OutputError("no output named; expected -o face.png")
    settings = _settings(**chosen)
    check_outputs(outputs, WITHOUT_SPEECH, alpha=settings.look.transparent)
    take = hold(_assignments(targets), emotion=_displays(emotions), settings=settings)
    take.write(*outputs)


@commands.command()
@click.argument("capture", type=click.Path(path_type=Path, dir_okay=True))
@click.option("--audio", metavar="FILE", help="A sound to go with it: WAV, FLAC, OGG or MP3.")
@_OUTPUT_OPTION
@_SAMPLING_OPTION
@_SKIN_OPTION
@_picture_options
@_AT_OPTION
@_EVERY_OPTION
def play(capture: Path, audio: str | None, outputs: tuple[Path, ...], **chosen: Any) -> None:
    """Perform a captured face: CAPTURE is .arkit.csv, .au.csv, .fap, a score or a performance (.json).

    Any other .csv is read as a take of the Live Link Face app.
    """
    from .api import play as perform
    from .console import Console
    from .ports.targets import check_targets as check_outputs

    if not outputs:
        raise OutputError("no output named; expected -o y.mp4")
    with Console() as console:
        check_outputs(outputs)
        take = perform(capture, audio=audio, settings=_settings(**chosen), progress=console.progress)
        take.write(*outputs, progress=console.progress)
        console.say(f"Wrote {', '.join(str(output) for output in outputs)}")


@commands.command()
@click.argument("source", metavar="INPUT")
@click.option("--protocol", default="livelink", metavar="NAME", help="livelink, vmc, ifacialmocap[-tcp].")
@click.option("--to", metavar="HOST[:PORT]", help="Who receives it.  [default: 127.0.0.1]")
@click.option(
    "--listen", metavar="HOST[:PORT]", help="Send to who greets here, as receivers of iFacialMocap do."
)
@click.option(
    "--patience",
    type=click.FloatRange(0.0, min_open=True),
    default=60.0,
    metavar="S",
    help="How long to wait for a greeting.  [default: 60]",
)
@click.option("--subject", metavar="NAME", help="The name that the receiver shows.  [default: risorius]")
@click.option("--names", metavar="SET", help="Expressions over VMC: vrm0, vrm1, arkit or ARKit.")
@click.option("--without-sound", is_flag=True, help="Do not play the voice here; the machine's clock counts.")
@click.option("--emotion", "emotions", multiple=True, metavar="NAME:INTENSITY[@START-END]", help="Show one.")
@_SAMPLING_OPTION
@click.option("--head", metavar="NAME", help="The head that performs.  [default: standard]")
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
    from .api import speak as perform
    from .console import Console
    from .stream import PATIENCE, PROTOCOLS, Options, check_options, parse_address, send_take

    given = {"subject": subject, "names": names}
    options = Options(**{name: value for name, value in given.items() if value is not None})
    check_options(protocol, options)
    if listen is None and patience != PATIENCE:
        raise UnreadError(["patience"], "no greeting is waited for; expected --listen as well")
    if to is not None and listen is not None:
        raise InputError("--to and --listen exclude each other; expected one of them")
    to = to or "127.0.0.1"
    parse_address(listen or to, PROTOCOLS.get(protocol).port)
    with Console() as console:
        take = perform(
            source, emotion=_displays(emotions), settings=_settings(**chosen), progress=console.progress
        )
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
    from .api import rig as report
    from .api import speak as speak_
    from .console import Console
    from .narration import tell_rig
    from .settings import Settings

    if (perform is None) != (output is None):
        raise InputError("--perform and -o go together; expected both or neither")
    settings = _settings(**chosen)
    with Console() as console:
        take = (
            None
            if perform is None
            else partial(speak_, perform, settings=settings, progress=console.progress)
        )
        measured = settings if take is None else Settings(head=settings.head)
        found, rows = report(character, map_file=map_file, take=take, output=output, settings=measured)
        for line in tell_rig(found, rows, guessed=map_file is None):
            click.echo(line)
        if output is not None:
            console.say(f"Wrote {output}")


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
    from .api import load
    from .core.parameters import parameters_named
    from .narration import narrate, tell

    if at is None and parameter is not None:
        raise InputError("--parameter needs a time; expected --at SECONDS as well")
    if parameter is not None:
        parameters_named(parameter)
    take = load(performance)
    lines = tell(take.summary()) if at is None else narrate(take.explain(at, parameter), at)
    for line in lines:
        click.echo(line)


@commands.command(name="list")
@click.argument("what", type=click.Choice(_LISTED))
def list_(what: str) -> None:
    """List what can be named."""
    from .console import table
    from .listing import LISTINGS

    header, rows = LISTINGS[what]()
    for line in table(header, rows):
        click.echo(line)


@commands.command()
@click.option("--port", type=click.IntRange(0, 65535), help="Port; 0 is any that is free.  [default: 8765]")
@click.option("--no-browser", is_flag=True, help="Do not open a browser.")
@click.option(
    "--folder", type=click.Path(path_type=Path), help="Where sessions are kept.  [default: the user's data]"
)
def studio(port: int | None, no_browser: bool, folder: Path | None) -> None:
    """See, hear and shape a performance in the browser, on this machine alone."""
    from .studio.server import PORT, serve

    serve(PORT if port is None else port, folder=folder, browser=not no_browser, say=_say)
    leave()


@commands.group()
def rules() -> None:
    """Look at the rules that turn speech into movements: ours, as a file of yours changes them."""


@rules.command(name="list")
@click.argument("prefix", required=False)
@_RULES_OPTION
def list_rules(prefix: str | None, rules: Path | None) -> None:
    """List all rules, or those whose id is PREFIX or begins with it up to a dot."""
    from .console import table
    from .listing import rule_rows

    for line in table(*rule_rows(rules, prefix)):
        click.echo(line)


@rules.command()
@click.argument("name")
@_RULES_OPTION
def show(name: str, rules: Path | None) -> None:
    """Show the rule NAME as it stands in its file, and where."""
    from .listing import rule_lines

    for line in rule_lines(name, rules):
        click.echo(line)


@rules.command()
@_RULES_OPTION
def doctor(rules: Path | None) -> None:
    """Check the rules: those that can never fire, name nothing, or stand in each other's way."""
    from .rules.book import book_of
    from .rules.doctor import examine

    book = book_of(rules)
    findings = examine(book)
    for finding in findings:
        click.echo(str(finding))
    if findings:
        raise InputError(f"{len(findings)} of {len(book.entries)} rules are ill; expected none")
    click.echo(f"{len(book.entries)} rules are well")
