"""Columns of tables with ARKit's 52 shapes, as programs other than Live Link Face name them.

NVIDIA Audio2Face writes `animation_frames.csv`: the number of a row, `timeCode` in seconds, and
`blendShapes.EyeBlinkLeft` …, some with shapes of the tongue that ARKit does not have. MediaPipe's face
landmarker has the 52 names in small letters, but `_neutral` in place of the tongue.
"""

from __future__ import annotations

from collections.abc import Sequence

from ...core.arkit import CSV_SHAPES
from ...errors import InputError, Place, RisoriusWarning, unknown, warn
from .capture import UNNAMED, Header, number

TIMECODE = "Timecode"
TONGUE = "TongueOut"
# Columns of a time, and how many of its units are a second.
SECONDS = {"timestamp": 1.0, "time": 1.0, "timestamp_ms": 1000.0, "time_ms": 1000.0}
_PREFIX = "blendshapes."
_STRANGE = "blendShapes."
# Columns that hold nothing of the face.
_PASSED = ("_neutral", "frame", "index", UNNAMED)
_SHOWN = 4


def here(name: str) -> str:
    """Return what a column is called here: without the name of the table that Audio2Face puts before it."""
    if not name.lower().startswith(_PREFIX):
        return name
    shape = name[len(_PREFIX) :]
    return shape if shape.lower() in _KNOWN else f"{_STRANGE}{shape}"


_KNOWN = frozenset(name.lower() for name in CSV_SHAPES)


def time_column(header: Header) -> str:
    """Return the name of the column with the times; raise InputError if no column has them."""
    found = [name for name in header.names if name == TIMECODE or name.lower() in SECONDS]
    if not found:
        header.require((TIMECODE,), "a Live Link Face take")
    return found[0]


def seconds(text: str, per_second: float = 1.0) -> float:
    """Read a time in seconds, or in `per_second` parts of one; raise ValueError for another text."""
    return number(text)[0] / per_second


def check_columns(header: Header, known: Sequence[str]) -> None:
    """Raise InputError for a column that is neither known nor one of those left out; warn of these."""
    time = time_column(header)
    left_out = []
    for name in header.names:
        if name.startswith(_STRANGE) or name == "_neutral":
            left_out.append(name)
        elif name not in known and name != time and name.lower() not in _PASSED:
            raise InputError(unknown("column", name, known), header.place(name))
    reasons = []
    if left_out:
        more = f" and {len(left_out) - _SHOWN} more" if len(left_out) > _SHOWN else ""
        reasons.append(f"{', '.join(left_out[:_SHOWN])}{more} left out: not a shape of ARKit")
    if TONGUE not in header.names:
        reasons.append(f"no column {TONGUE}: the tongue stays in")
    if reasons:
        warn(f"{Place(str(header.path), header.line)}: {'; '.join(reasons)}", RisoriusWarning)
