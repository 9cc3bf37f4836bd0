"""A sheet of charts as data: rows of panels with lines, and a row of faces. `draw.py` draws it."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..core.arrays import Array, ByteArray
from ..core.speech.utterance import Utterance

ChartColour = tuple[int, int, int]
"""Red, green, blue, 0 to 255."""
INK: ChartColour = (34, 48, 60)
SOFT: ChartColour = (112, 126, 141)
SHOWN: ChartColour = (11, 122, 117)
RIVAL: ChartColour = (226, 150, 40)
SECOND: ChartColour = (91, 111, 181)


@dataclass(frozen=True, slots=True)
class ChartLine:
    """A curve: `values` at `times` (seconds), both shape (n,).

    `dashed`: drawn as dashes; `filled`: lightly, down to zero. `width` in pixels.
    """

    label: str
    times: Array
    values: Array
    colour: ChartColour = SHOWN
    width: float = 2.2
    dashed: bool = False
    filled: bool = False


@dataclass(frozen=True, slots=True)
class Panel:
    """Axes with lines. `phases`: spans of seconds with their names, written above; `marks`: named times."""

    title: str
    lines: tuple[ChartLine, ...]
    phases: tuple[tuple[float, float, str], ...] = ()
    marks: tuple[tuple[float, str], ...] = ()


@dataclass(frozen=True, slots=True)
class ChartRow:
    """Panels side by side with the same axes, from `start` to `end` seconds and `low` to `high`.

    `said`: what is spoken meanwhile, written above the panels.
    """

    title: str
    panels: tuple[Panel, ...]
    start: float
    end: float
    low: float = 0.0
    high: float = 1.0
    axis: str = "activity"
    said: Utterance | None = None


@dataclass(frozen=True, slots=True)
class LabelledFace:
    """A picture of a face, (height, width, 3 or 4) uint8, and what stands below it."""

    picture: ByteArray
    label: str


@dataclass(frozen=True)
class ChartSheet:
    """Rows of charts, and faces below them."""

    title: str
    rows: tuple[ChartRow, ...]
    faces: tuple[LabelledFace, ...] = field(default=())
