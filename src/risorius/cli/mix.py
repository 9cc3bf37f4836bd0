"""`risorius mix`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..settings.declare import Stage
from .console import Console
from .options import (
    LINKS_ALONE,
    SHOWN,
    Command,
    check_outputs,
    output_option,
    setting_options,
    settings_from,
)
from .outputs import written

PRINTED = "-.muscles.csv"


@click.command(cls=Command, short_help="Combine the movements of a score into curves.")
@click.argument("score", type=click.Path(path_type=Path, dir_okay=True))
@output_option
@setting_options(
    (Stage.COMBINE, *SHOWN), ("rules",), defaults={Stage.COMBINE: "the score's"}, words=LINKS_ALONE
)
def mix(score: Path, outputs: tuple[Path, ...], **chosen: Any) -> None:
    """Combine the movements of SCORE (.json) into curves.

    Without -o the curves go to standard output as CSV. The settings are the score's; options override them.
    """
    from ..api import mix as combine

    settings, outputs = settings_from(chosen), outputs or (Path(PRINTED),)
    with Console() as console, written(console, outputs) as files:
        check_outputs(files, settings, read_by={"rules": Stage.SKIN})
        take = combine(score, settings=settings, progress=console.progress)
        take.write(*files, progress=console.progress)
