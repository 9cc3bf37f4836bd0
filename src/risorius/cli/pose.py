"""`risorius pose`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..core.names import Names
from ..errors import InputError, OutputError
from ..settings.declare import Stage
from .console import Console
from .options import (
    LINKS_ALONE,
    Command,
    Named,
    check_outputs,
    emotion_option,
    output_option,
    setting_options,
    settings_from,
)
from .outputs import written

TARGETS = Names(path="core.action_units:target_names")
WITHOUT_SPEECH = ("movements", "curves", "vertices", "pixels", "head")


@click.command(cls=Command, short_help="Draw one face: emotions, action units, muscles.")
@click.argument("targets", nargs=-1, metavar="NAME=VALUE …", type=Named(TARGETS, after="="))
@emotion_option
@output_option
@setting_options(
    (Stage.HEAD, Stage.SHAPE, Stage.SKIN, Stage.APPEARANCE, Stage.PICTURE),
    ("rules", "names"),
    words=LINKS_ALONE,
)
def pose(
    targets: tuple[str, ...], emotions: tuple[str, ...], outputs: tuple[Path, ...], **chosen: Any
) -> None:
    """Draw one face: muscles, action units or other parameters, 0 to 1 (degrees for head and gaze).

    A name without .left or .right means both sides: risorius pose zygomatic_major=0.7 AU1=0.5 -o face.png
    """
    from ..api import pose as hold

    if not outputs:
        raise OutputError("no output named; expected -o face.png")
    settings = settings_from(chosen)
    with Console() as console, written(console, outputs) as files:
        check_outputs(files, settings, WITHOUT_SPEECH, {"rules": Stage.SKIN})
        take = hold(_assignments(targets), emotion=emotions, settings=settings)
        take.write(*files)


def _assignments(targets: tuple[str, ...]) -> dict[str, float]:
    from ..core.parameters import ALIASES
    from ..rules.emotions import emotion_names

    values: dict[str, float] = {}
    for text in targets:
        name, equals, value = text.partition("=")
        if name.lower() in emotion_names() and name.lower() not in ALIASES:
            raise InputError(f"'{name}' is an emotion; expected --emotion {name}:{value or 0.7}")
        try:
            if not equals or not name:
                raise ValueError
            number = float(value)
        except ValueError:
            raise InputError(f"'{text}' is not NAME=VALUE; expected e.g. zygomatic_major=0.7") from None
        if name in values:
            raise InputError(f"'{name}' is given twice; expected one value")
        values[name] = number
    return values
