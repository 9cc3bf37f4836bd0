"""The table of all that reads foreign bytes: a new reader is one line, in `readers` or in `messages`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True, slots=True)
class FuzzedReader:
    """What reads a file: its name's ending, right contents, and the strict tables that are read from it.

    `share`: a slow reader is given so many of the cases of others.
    """

    suffix: str
    read: Callable[[Path], object]
    samples: Callable[[], tuple[bytes, ...]]
    tables: tuple[str, ...] = ()
    share: float = 1.0


READERS: dict[str, FuzzedReader] = {}


def register(
    suffix: str,
    read: Callable[[Path], object],
    *samples: bytes | Path | Callable[[], bytes],
    tables: str = "",
    share: float = 1.0,
) -> None:
    """Register a reader of files; a sample may be made when it is first needed."""

    @cache
    def contents() -> tuple[bytes, ...]:
        return tuple(
            s if isinstance(s, bytes) else s.read_bytes() if isinstance(s, Path) else s() for s in samples
        )

    READERS[suffix] = FuzzedReader(suffix, read, contents, tuple(tables.split()), share)
