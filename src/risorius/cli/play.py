"""`risorius play`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..errors import OutputError
from .console import Console
from .options import SHOWN, Command, check_outputs, option, output_option, setting_options, settings_from
from .outputs import written


@click.command(cls=Command, short_help="Perform a captured face: ARKit, OpenFace, MPEG-4.")
@click.argument("capture", type=click.Path(path_type=Path, dir_okay=True))
@option("--audio", group="Input", metavar="FILE", help="The sound of the performance: WAV, MP3, a film …")
@option("--face", group="Input", metavar="N", type=int, help="The face's number in a file with several")
@output_option
@setting_options(SHOWN)
def play(
    capture: Path, audio: str | None, face: int | None, outputs: tuple[Path, ...], **chosen: Any
) -> None:
    """Perform a captured face: CAPTURE is .arkit.csv, .au.csv, .fap, a score or a performance (.json).

    Any other .csv is read by its columns: those of Live Link Face, OpenFace, Audio2Face or MediaPipe.
    """
    if not outputs:
        raise OutputError("no output named; expected -o y.mp4")
    settings = settings_from(chosen)
    with Console() as console, written(console, outputs) as files:
        from ..api import play as perform

        check_outputs(files, settings)
        take = perform(capture, audio=audio, face=face, settings=settings, progress=console.progress)
        take.write(*files, progress=console.progress)
