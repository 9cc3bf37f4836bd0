"""`risorius mix`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..core.setting import Stage
from .console import Console
from .options import SHOWN, Command, check_outputs, output_option, setting_options, settings_from


@click.command(cls=Command)
@click.argument("score", type=click.Path(path_type=Path, dir_okay=True))
@output_option
@setting_options((Stage.COMBINE, *SHOWN))
def mix(score: Path, outputs: tuple[Path, ...], **chosen: Any) -> None:
    """Combine the movements of SCORE (.json) into curves.

    Without -o the curves go to standard output as CSV. What no option chooses is as the score says.
    """
    from ..api import mix as combine
    from ..ports.formats import FORMATS
    from ..unread import refuse_unwritten

    settings = settings_from(chosen)
    if outputs:
        check_outputs(outputs, settings)
    else:
        refuse_unwritten(settings, [FORMATS.get(".muscles.csv")])
    with Console() as console:
        take = combine(score, settings=settings, progress=console.progress)
        if outputs:
            take.write(*outputs, progress=console.progress)
    if not outputs:
        from ..ports.muscles_csv import rows

        for row in rows(take.performance):
            click.echo(row)
