"""`risorius explain`."""

from __future__ import annotations

from pathlib import Path

import click

from ..core.names import Names
from ..errors import InputError
from .options import Command, Named, NumberIn, option


@click.command(cls=Command, short_help="Explain why the face does what it does.")
@click.argument("performance", type=click.Path(path_type=Path, dir_okay=True))
@option(
    "--at",
    group="Output",
    type=NumberIn(0.0, kind=float),
    metavar="S",
    help="Time to explain, in seconds. Without it, a summary of the clip.",
)
@option(
    "--parameter",
    group="Output",
    metavar="NAME",
    type=Named(Names(path="core.parameters:BASES")),
    help="Explain one muscle or other parameter. Without it, all that move.",
)
def explain(performance: Path, at: float | None, parameter: str | None) -> None:
    """Say why the face does what it does, from a PERFORMANCE (.performance.json).

    For each value you see the movement that won, its cause in the script, and why each other movement lost.
    """
    from ..api import load
    from ..blend.narrate import narrate
    from ..core.parameters import parameters_named
    from .narration import tell

    if at is None and parameter is not None:
        raise InputError("--parameter needs a time; expected --at SECONDS as well")
    if parameter is not None:
        parameters_named(parameter)
    take = load(performance)
    lines = tell(take.summary()) if at is None else narrate(take.explain(at, parameter), at)
    for line in lines:
        click.echo(line)
