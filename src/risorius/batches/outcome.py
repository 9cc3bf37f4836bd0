"""The outcome of a line: its files and their properties, or the reason why it failed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from ..errors import Place


@dataclass(frozen=True, slots=True)
class Outcome:
    """A worker's report on a line.

    `error`: one line, empty if all went well; `stops`: it concerns all lines that follow (a full disk).
    `duration`: seconds of the performance; `cpu`: seconds of processor time; `memory`: bytes that the
    process holds. `outputs`: the size of each file in bytes. `doubt`: how badly the worst word of a recording
    fits its sound (0 fits; from 50 on it is in doubt), `doubtful` those words. `warnings`: one line each.
    `text`: what is said, its beginning if it is long. `sound`: the file in which it is heard, `sheet` that of
    its pictures for the report; empty if there is none.
    """

    error: str = ""
    stops: bool = False
    duration: float = 0.0
    words: int = 0
    cpu: float = 0.0
    memory: int = 0
    outputs: Mapping[str, int] = field(default_factory=dict)
    doubt: float = 0.0
    doubtful: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    text: str = ""
    sound: str = ""
    sheet: str = ""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Outcome:
        """Return an outcome that was written as JSON; raises TypeError if the text is not an outcome."""
        lists = {name: tuple(data.get(name, ())) for name in ("doubtful", "warnings")}
        return cls(**{**data, **lists})


class LineState(StrEnum):
    """Whether a line was made in this run, is complete from an earlier one, or failed."""

    MADE = "made"
    WHOLE = "whole"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class LineResult:
    """A line of a batch: its id (empty if the row has none), the place of its row, its state and outcome."""

    id: str
    place: Place
    state: LineState
    outcome: Outcome

    @property
    def error(self) -> str:
        """The place and reason of the failure, in one line; empty if it did not fail."""
        error, place = self.outcome.error, f"{self.place}: "
        return error if not error or error.startswith(place) else place + error
