"""What a page may not exceed, and the numbers of a profile with their ranges."""

from __future__ import annotations

import dataclasses
import math
import typing
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ..core.schema import Range

# Characters of a script; bytes of an upload, of a message, of a request that is no upload.
SCRIPT = 200_000
RECORDING = 100_000_000
PROJECT = 200_000_000
MESSAGE = 4_000_000
# Requests of one page at once; sessions open at once; takes that a session keeps beside the one that is
# edited; changes that can be undone.
PENDING = 64
SESSIONS = 32
TAKES = 6
UNDO = 200
# Seconds that a script may last, and files that one export may write.
LONGEST = 3600.0
EXPORTED = 40


def described() -> dict[str, float]:
    """Return the limits that a page should know."""
    return {
        "script": SCRIPT,
        "recording": RECORDING,
        "project": PROJECT,
        "message": MESSAGE,
        "pending": PENDING,
        "undo": UNDO,
    }


@dataclass(frozen=True, slots=True)
class Number:
    """A number of a profile: its dotted key, value and range (null where there is no end)."""

    key: str
    value: float
    low: float | None
    high: float | None


def profile_numbers(item: Any, prefix: str = "") -> Iterator[Number]:
    """Yield all numbers in a dataclass, those of a tuple as `key.0`, of a mapping as `key.name`."""
    hints = typing.get_type_hints(type(item), include_extras=True)
    for f in dataclasses.fields(item):
        yield from _numbers(f"{prefix}{f.name}", getattr(item, f.name), hints[f.name])


def _numbers(key: str, value: Any, hint: Any) -> Iterator[Number]:
    limits = next((a for a in _inside(hint) if isinstance(a, Range)), Range())
    if dataclasses.is_dataclass(value):
        yield from profile_numbers(value, f"{key}.")
    elif isinstance(value, Mapping):
        for name, number in value.items():
            yield from _numbers(f"{key}.{name}", number, hint)
    elif isinstance(value, tuple):
        for place, number in enumerate(value):
            yield from _numbers(f"{key}.{place}", number, hint)
    elif isinstance(value, float | int) and not isinstance(value, bool):
        ends = [None if math.isinf(end) else end for end in (limits.low, limits.high)]
        yield Number(key, float(value), *ends)


def _inside(hint: Any) -> Iterator[Any]:
    """Yield a type's arguments, all the way down."""
    yield hint
    for argument in (*getattr(hint, "__metadata__", ()), *typing.get_args(hint)):
        yield from _inside(argument)
