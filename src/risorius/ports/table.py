"""Tables of numbers as CSV: a header, then one row per frame."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

from ..core.arrays import Array

TableRow = Sequence[float] | Array


def table_lines(columns: Sequence[str], rows: Iterable[TableRow], decimals: Sequence[int]) -> Iterator[str]:
    """Yield the header, then `rows`, each of len(columns) numbers, with `decimals` digits per column.

    Lines have no end. Raises ValueError for a row of another length.
    """
    layout = ",".join(f"%.{digits}f" for digits in decimals)
    scale = np.power(10.0, np.asarray(decimals))
    yield ",".join(columns)
    for row in rows:
        values = np.asarray(row, dtype=np.float64)
        if values.shape != (len(columns),):
            raise ValueError(f"a row has shape {values.shape}; expected ({len(columns)},)")
        yield layout % tuple(_without_negative_zero(values, scale))


def write_lines(path: Path, lines: Iterable[str]) -> None:
    """Write lines as UTF-8, ended by "\\n" on every system."""
    with path.open("w", encoding="utf-8", errors="replace", newline="") as file:
        file.writelines(f"{line}\n" for line in lines)


def _without_negative_zero(values: Array, scale: Array) -> Array:
    """Set values that would print as -0.000 to 0, so that a meaningless sign does not change the file."""
    return np.where(np.abs(values) * scale <= 0.5, 0.0, values)
