"""Events: messages that the server sends without a request, by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from .answers import Download


@dataclass(frozen=True, slots=True)
class ProgressEvent:
    """The progress of a request (`re`) or an export (`job`); `total` is 0 if it is not known."""

    stage: str
    done: int
    total: int
    re: int | None = None
    job: int | None = None


@dataclass(frozen=True, slots=True)
class Exported:
    """An export has ended: its files, or the error that stopped it."""

    job: int
    files: tuple[Download, ...]
    error: str = ""


@dataclass(frozen=True, slots=True)
class Changed:
    """Another page of the same session has changed the take: `take` is the number of the new one."""

    take: int


@dataclass(frozen=True, slots=True)
class Saved:
    """The project was saved automatically, or `error` says why it was not."""

    error: str = ""


@dataclass(frozen=True, slots=True)
class Ready:
    """Whether the server is "warming" (it loads the face; the first one waits for it) or is "warm"."""

    what: Literal["warming", "warm"]


EVENTS: Mapping[str, type] = {
    "progress": ProgressEvent,
    "exported": Exported,
    "changed": Changed,
    "saved": Saved,
    "ready": Ready,
}
