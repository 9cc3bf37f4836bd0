"""`risorius speak`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from ..core.setting import Stage
from ..errors import InputError, UnreadError
from .console import Console
from .options import (
    SHOWN,
    Command,
    check_outputs,
    displays,
    emotion_option,
    option,
    output_option,
    setting_options,
    settings_from,
)
from .outputs import files_for

DEFAULT_OUTPUT = "performance.mp4"
LONGEST_INPUT = 4_000_000


@click.command(cls=Command)
@click.argument("source", metavar="[INPUT]", required=False)
@output_option
@option(
    "--text",
    "is_text",
    group="Input",
    is_flag=True,
    help="Speak INPUT as text, even if it looks like a file name.",
)
@emotion_option
@option(
    "--audio",
    group="Input",
    metavar="FILE",
    help="A recorded voice: WAV, FLAC, OGG, MP3, M4A, or the sound of a film.",
)
@option(
    "--transcript",
    group="Input",
    metavar="TEXT|FILE",
    help="The words of the recording, or a file that holds them.  [default: INPUT]",
)
@setting_options((Stage.VOICE, Stage.PLAN, Stage.COMBINE, *SHOWN))
def speak(
    source: str | None,
    outputs: tuple[Path, ...],
    is_text: bool,
    emotions: tuple[str, ...],
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
        raise UnreadError(["text"], "INPUT is missing; expected a text, or --transcript TEXT")
    settings = settings_from(chosen)
    outputs, named = outputs or (Path(DEFAULT_OUTPUT),), bool(outputs)
    with Console() as console, files_for(outputs) as files:
        if not named:
            console.say(f"Writing {DEFAULT_OUTPUT} (choose with -o)")
        source, name = (source, "text") if source != "-" else (_standard_input(), "stdin")
        from ..api import speak as perform

        check_outputs(files, settings)
        take = perform(
            source,
            audio=audio,
            transcript=transcript,
            text=is_text or name == "stdin",
            source=name,
            emotion=displays(emotions),
            settings=settings,
            progress=console.progress,
        )
        take.write(*files, progress=console.progress)
        console.wrote(outputs)


def _standard_input() -> str:
    from ..script.files import decode

    if sys.stdin is None:
        raise InputError("standard input is closed; expected a text on it")
    return decode(sys.stdin.buffer.read(LONGEST_INPUT), "stdin")
