"""The table of muscles of a head: one row each, with type, line of pull, zone, source and links."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

from ...core.muscle_coupling import Link
from ...core.parameters import MUSCLES
from ...errors import HeadError, ParameterError, Place, unknown
from ...reading.hints import Range
from ...reading.toml import load_rows

FILE = "muscles.toml"
NAMES = (*dict.fromkeys(m.base for m in MUSCLES), "lip_tuck")
Point3 = tuple[float, float, float]
"""x, y, z."""
ForceType = Literal["linear", "sheet", "sphincter", "rotation", "bulge", "protrusion"]
"""The six types of force (paper B, section 6.1, has six without naming them; the choice is ours)."""


PullLine = tuple[Point3, Point3]
ZoneWidth = Annotated[float, Range(0.0, 200.0)]


def _check_line(line: PullLine) -> None:
    if line[0] == line[1]:
        raise ParameterError("line has no length; expected two different points")


@dataclass(frozen=True, slots=True)
class Force:
    """A force that a muscle of several lines or types gathers with that of its row (paper B, section 6.1).

    `moves`: mm by which it alone moves, at full contraction, the point of the skin that it moves most.
    """

    type: ForceType
    line: PullLine
    zone: ZoneWidth
    moves: Annotated[float, Range(0.0, 50.0)]

    def __post_init__(self) -> None:
        _check_line(self.line)


@dataclass(frozen=True, slots=True)
class Muscle:
    """One row. Points are mm in the head frame, on the subject's left; `zone` mm from the line.

    `gathered`: forces that add to the row's own. The builder of heads reads the recipe of the calibrated
    field: `shapes`, `part`, `lips`, `smooth`, `narrow`.
    """

    origin: str
    insertion: str
    action: str
    type: ForceType
    line: PullLine
    zone: ZoneWidth
    source: str
    shapes: Mapping[str, float] = field(default_factory=dict)
    part: str = "all"
    lips: Literal["free", "together", "no overlap"] = "free"
    smooth: float = 0.0
    narrow: float = 0.0
    gathered: tuple[Force, ...] = ()

    def __post_init__(self) -> None:
        _check_line(self.line)


def load_muscles(folder: Path) -> dict[str, Muscle]:
    """Return the rows of the table in a head's `folder` by the muscle's name without side, and `lip_tuck`.

    Raises InputError with file and line if a row does not fit, and HeadError if a muscle is missing or
    unknown.
    """
    path = folder / FILE
    rows = load_rows(Muscle, path)
    for name in rows:
        if name not in NAMES:
            raise HeadError(unknown("muscle", name, NAMES), Place(str(path)))
    for name in NAMES:
        if name not in rows:
            raise HeadError(f"muscle '{name}' is missing", Place(str(path)))
    return rows


def links_of(muscle: str, links: Iterable[Link]) -> dict[str, float]:
    """Return the weights, 0..1, of the muscles linked to a muscle, by name or "NAME (other side)"."""
    return {
        link.linked + (" (other side)" if link.sides == "other" else ""): link.weight
        for link in links
        if link.muscle == muscle
    }
