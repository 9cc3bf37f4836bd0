"""Ticks: events stand on multiples of 1/705,600,000 s: equal times are equal however they are computed.

A tick is a whole part of a sample at 8, 11.025, 12, 16, 22.05, 24, 32, 44.1, 48, 88.2, 96, 176.4 and 192 kHz,
and of a frame at 24, 25, 30, 48, 50, 60, 72, 75, 90, 96, 100, 120, 144 and 240 frames a second and at 24, 30,
60 and 120 times 1000/1001. At other rates (37.8 kHz) samples lie up to half a tick, 0.7 ns, beside one.

Events keep and tell their times in seconds: the float nearest to a whole number of ticks. Up to two months no
two ticks have the same float, so that comparing such floats compares ticks.
"""

from __future__ import annotations

from math import isfinite

import numpy as np

from .arrays import Array

Ticks = int
"""A time or a duration in ticks."""

TICKS_PER_SECOND: Ticks = 705_600_000
_put = object.__setattr__
TICK = 1.0 / TICKS_PER_SECOND
"""A tick in seconds: no two moments are told apart that are nearer."""


def ticks_of(seconds: float) -> Ticks:
    """Return the number of ticks nearest to a finite time in seconds."""
    return round(seconds * TICKS_PER_SECOND)


def seconds_of(ticks: Ticks) -> float:
    """Return the time of a number of ticks in seconds, as the nearest float."""
    return ticks / TICKS_PER_SECOND


def on_tick(seconds: float) -> float:
    """Return the tick nearest to a time, both in seconds; infinite times and NaN stay."""
    return seconds_of(ticks_of(seconds)) if isfinite(seconds) else float(seconds)


def on_ticks(seconds: Array) -> Array:
    """Return the ticks nearest to times, in seconds, shape (n,) or any other; infinite times and NaN stay."""
    return np.asarray(np.rint(seconds * TICKS_PER_SECOND) / TICKS_PER_SECOND)


def put_on_ticks(event: object, *names: str) -> None:
    """Move the times of a frozen dataclass, its fields `names` in seconds, to the nearest ticks."""
    for name in names:
        seconds = getattr(event, name)
        # The same value as from `on_tick`, in a third of its time: every phone and movement passes here.
        try:
            tick = round(seconds * TICKS_PER_SECOND) / TICKS_PER_SECOND
        except (OverflowError, ValueError):  # infinite, or not a number
            tick = float(seconds)
        _put(event, name, tick)
