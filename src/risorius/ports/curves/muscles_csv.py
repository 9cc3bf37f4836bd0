"""`.muscles.csv`: the curves, one column per parameter."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...core.parameters import NAMES
from ...core.performance import Performance
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import table_lines, write_lines

COLUMNS = ("time_s", *NAMES)


def write_muscles_csv(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write the time in seconds, then every parameter in the table's order, to 1e-6."""
    write_lines(path, rows(take.performance))


def rows(performance: Performance) -> Iterator[str]:
    """Yield the lines of the table, the header first."""
    # Row by row: a second copy of all curves would double the memory of a long clip.
    numbers = (
        np.concatenate([[time], row]) for time, row in zip(performance.times, performance.values, strict=True)
    )
    return table_lines(COLUMNS, numbers, [6] * len(COLUMNS))


register(".muscles.csv", "curves of all muscles and parameters", {"curves"}, write_muscles_csv, order=6)
