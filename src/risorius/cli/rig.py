"""`risorius rig`."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import click

from ..errors import InputError
from .console import Console
from .options import Command, option, setting_options, settings_from


@click.command(cls=Command, short_help="Perform on your own character (.glb).")
@click.argument("character", type=click.Path(path_type=Path, dir_okay=True))
@option(
    "--map",
    "map_file",
    group="Input",
    type=click.Path(path_type=Path),
    help="TOML file that names the morph target of each ARKit shape.",
)
@option(
    "--perform",
    group="Input",
    metavar="INPUT",
    help="A text or file to perform on the character; needs -o.",
)
@option(
    "-o",
    "--output",
    group="Output",
    type=click.Path(path_type=Path),
    help="The character's .glb with its animation.",
)
@setting_options(names=("fps", "head"))
def rig(
    character: Path, map_file: Path | None, perform: str | None, output: Path | None, **chosen: Any
) -> None:
    """Check what your CHARACTER (.glb with blend shapes) can show, or perform on it.

    Without --map the targets are guessed by name and printed as a table: save, correct and pass it as --map.
    """
    from ..api import rig as report
    from ..api import speak
    from ..face.head.head import head_of
    from ..ports.mesh.rig import lips_apart
    from ..settings import Settings
    from .narration import tell_rig

    if (perform is None) != (output is None):
        raise InputError("--perform and -o go together; expected both or neither")
    settings = settings_from(chosen)
    with Console() as console:
        take = None
        if perform is not None:
            take = partial(speak, perform, settings=settings, progress=console.progress)
        measured = settings if take is None else Settings(head=settings.head)
        shown, rows = report(character, map_file=map_file, take=take, output=output, settings=measured)
        for line in tell_rig(shown, rows, guessed=map_file is None):
            click.echo(line)
        apart = lips_apart(shown, head_of(settings))
        click.echo(f"# a sealed mouth stays open by {apart:.2f} mm at most, from corner to corner")
        if output is not None:
            console.wrote([output])
