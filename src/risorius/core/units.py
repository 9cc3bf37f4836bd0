"""Numbers with a unit and a range, as tables, edits and messages hold them: the strict reader checks both.

A table's field takes the narrowest of these types that fits it, so that a slip of the pen is an error with
its line. Each name says what the range bounds.
"""

from typing import Annotated

from ..reading.hints import Range

Share = Annotated[float, Range(0.0, 1.0)]
"""A part of a whole, a probability, a confidence or an intensity."""

SignedShare = Annotated[float, Range(-1.0, 1.0)]
"""A part of a whole with a direction."""

MAX_SECONDS = 21_600.0
"""Six hours: the longest performance. A later moment is a slip of the pen, and would only fail later."""

Seconds = Annotated[float, Range(0.0, MAX_SECONDS)]
"""A time in a performance, or a duration."""

RiseSeconds = Annotated[float, Range(0.0, 10.0)]
"""The time for which a movement rises or falls, or waits before it begins."""

HabitSeconds = Annotated[float, Range(0.0, 60.0)]
"""The duration of one action of a habit, or of the pause after it: a fixation, a posture, a look away."""

MarkSeconds = Annotated[float, Range(0.01, 60.0)]
"""The duration of a mark of paper A's markup that gives none itself."""

BehaviourSeconds = Annotated[float, Range(0.1, 60.0)]
"""The duration of a behaviour of BML that gives none itself."""

ContactSeconds = Annotated[float, Range(0.001, 0.5)]
"""The time in which the lips change about a contact."""

GapMillimetres = Annotated[float, Range(0.01, 20.0)]
"""A gap between the lips."""

DeviationDegrees = Annotated[float, Range(0.0, 60.0)]
"""The excursion of the head or the eyes from their rest."""


def clock(seconds: float) -> str:
    """Return a duration as hours, minutes and seconds: 0:01:05."""
    whole = round(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02d}:{whole % 60:02d}"
