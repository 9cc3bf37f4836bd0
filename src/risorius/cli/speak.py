"""`risorius speak`."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import Any

import click

from ..settings.declare import Stage
from .console import Console
from .inputs import Spoken, input_options
from .options import SHOWN, Command, check_outputs, output_option, setting_options, settings_from
from .outputs import written

DEFAULT_OUTPUT = "performance.mp4"


@click.command(cls=Command, short_help="Perform a text, a script or a recorded voice.")
@click.argument("source", metavar="[INPUT]", required=False)
@output_option
@input_options
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

    Files: .txt, .xml, .utt, .ssml, .bml, .apml, .TextGrid, .score.json. Without -o the video
    performance.mp4 is written here.

    With --audio a recorded voice is performed. INPUT or --transcript gives its words; if INPUT is a
    .TextGrid, it gives their times as well. Without these the words are recognized.
    """
    spoken = Spoken(source, is_text, emotions, audio, transcript)
    settings = settings_from(chosen)
    outputs, named = outputs or (Path(DEFAULT_OUTPUT),), bool(outputs)
    with Console() as console, written(console, outputs) as files:
        if not named:
            console.say(f"Writing {DEFAULT_OUTPUT} (choose with -o)")
        check_outputs(files, settings)
        perform = spoken.perform_to_draw if _is_film(files) else spoken.perform
        take = perform(settings, console.progress)
        take.write(*files, progress=console.progress)


def _is_film(files: Collection[Path]) -> bool:
    """Whether a film is written, which is worth a process."""
    from ..ports.formats import format_for
    from ..ports.video.codecs import CODECS

    return any(format_for(file).suffix.removeprefix(".") in CODECS for file in files)
