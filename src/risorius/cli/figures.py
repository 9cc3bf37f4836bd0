"""`risorius figures`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..core.names import Names
from ..errors import OutputError
from ..settings.declare import Stage
from .console import Console
from .options import Command, Named, NumberIn, option, setting_options, settings_from
from .outputs import written


@click.command(cls=Command, short_help="Draw activities before and after they are combined.")
@click.argument("score")
@option(
    "-o",
    "--output",
    "outputs",
    group="Output",
    multiple=True,
    type=click.Path(path_type=Path, dir_okay=True),
    help="The picture to write, a .png; -.png writes to standard output.",
)
@option(
    "--parameter",
    "parameters",
    group="Output",
    multiple=True,
    metavar="NAME",
    type=Named(Names(path="core.parameters:BASES")),
    help="A muscle or other parameter to draw; may be given several times. Without it, the six that the "
    "combination changes most.",
)
@option("--start", group="Output", type=NumberIn(0.0, kind=float), metavar="S", help="First second to draw.")
@option("--end", group="Output", type=NumberIn(0.0, kind=float), metavar="S", help="Last second to draw.")
@setting_options((Stage.COMBINE,), defaults={Stage.COMBINE: "the score's"})
def figures(
    score: str,
    outputs: tuple[Path, ...],
    parameters: tuple[str, ...],
    start: float | None,
    end: float | None,
    **chosen: Any,
) -> None:
    """Draw activities before and after they are combined, as Figures 4 to 7 of paper A do.

    SCORE is a .score.json, or paper-a for the paper's own figures.
    """
    from ..charts.figures import check_figure
    from ..charts.figures import figures as draw

    if len(outputs) != 1:
        raise OutputError("figures are one picture; expected one -o fig.png")
    check_figure(outputs[0])
    settings = settings_from(chosen)
    with Console() as console, written(console, outputs) as files:
        draw(
            score,
            files[0],
            parameters=parameters,
            start=start,
            end=end,
            settings=settings,
            progress=console.progress,
        )
