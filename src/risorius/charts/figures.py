"""`risorius.figures`: activities before and after their combination, drawn."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from ..api import checked, mix
from ..core.progress import Progress, quiet
from ..core.units import MAX_SECONDS
from ..errors import InputError, OutputError, Place, UnusedSettingError, check_number
from ..machine.atomic import replacing
from ..machine.paths import path_of
from ..settings import Settings
from ..settings.declare import Stage
from ..unused_settings import InputKind, reject
from .draw import drawn
from .paper_a import PRESET, paper_sheet
from .score import score_sheet
from .sheet import ChartSheet

SUFFIX = ".png"
FIGURES = InputKind(
    "figures", (Stage.COMBINE,), "figures show activities as they are combined; expected only e.g. conflict"
)


def figures(
    score: str | os.PathLike[str],
    output: str | os.PathLike[str] | None = None,
    *,
    parameters: Sequence[str] = (),
    start: float | None = None,
    end: float | None = None,
    settings: Settings | None = None,
    progress: Progress = quiet,
) -> ChartSheet:
    """Return charts of activities before and after they are combined; write them to `output`, a PNG.

    `score`: a score file, or "paper-a" for Figures 4 to 7 of paper A by our combination. A row shows each
    channel's request for a parameter, and what is shown of it: of the `parameters` (names with or without
    side), or of the six that the combination changes most, from `start` to `end` seconds. `settings.blend`
    overrides the score's own; no other setting is read. Raises RisoriusError.
    """
    if output is not None:
        check_figure(output)
    for name, value in (("start", start), ("end", end)):
        if value is not None:
            check_number(name, value)
            if not 0.0 <= value <= MAX_SECONDS:
                raise InputError(f"{name} = {value:g} is out of range; expected 0 to {MAX_SECONDS:g} s")
    if isinstance(parameters, str):
        raise InputError(f"parameters = '{parameters}' is a text; expected a sequence of names")
    settings = checked(settings)
    reject(settings, FIGURES)
    if score == PRESET:
        given = {"parameters": tuple(parameters) or None, "start": start, "end": end}
        if unused := [name for name, value in given.items() if value is not None]:
            raise UnusedSettingError(unused, "the paper's figures show what they show; expected a score")
        sheet = paper_sheet(settings.blend, progress)
    else:
        take = mix(score, settings=settings, progress=progress)
        sheet = score_sheet(take, path_of(score).name, tuple(parameters), start, end)
    if output is not None:
        with replacing(Path(output)) as path:
            drawn(sheet).save(path, format="PNG", optimize=True)
    return sheet


def check_figure(output: str | os.PathLike[str]) -> None:
    """Raise OutputError unless `output` is a name for a PNG."""
    if not os.fspath(output).lower().endswith(SUFFIX):
        raise OutputError(
            f"figures are drawn as {SUFFIX}; expected e.g. -o fig{SUFFIX}", Place(os.fspath(output))
        )
