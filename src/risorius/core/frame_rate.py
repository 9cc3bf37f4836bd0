"""Exact frame rates: a float cannot hold 24000/1001."""

from __future__ import annotations

import re
from fractions import Fraction

from ..errors import InputError

MAX_FPS = 1000
# The numbers that Fraction reads, but short ones only: it would compute 1e10000000 to the last digit.
_RATE = re.compile(r"[+-]?(?:\d{1,12}(?:/\d{1,12}|(?:\.\d{0,12})?(?:[eE][+-]?\d{1,2})?)|\.\d{1,12})")


def parse_fps(text: str | float | Fraction) -> Fraction:
    """Return a frame rate such as 30, "29.97" or "24000/1001"; raise InputError unless in (0, 1000]."""
    try:
        if isinstance(text, bool) or (isinstance(text, str) and not _RATE.fullmatch(text.strip())):
            raise ValueError
        fps = Fraction(text) if not isinstance(text, float) else Fraction(text).limit_denominator(100_000)
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        shown = text[:40] if isinstance(text, str) else type(text).__name__
        raise InputError(f"fps '{shown}' is not a number; expected e.g. 30, 25 or 24000/1001") from None
    if not 0 < fps <= MAX_FPS:
        # A whole number may have more digits than Python writes.
        shown_fps = text if abs(fps) < 10**40 else "a number of many digits"
        raise InputError(f"fps = {shown_fps} is out of range; expected more than 0 and at most {MAX_FPS}")
    return fps
