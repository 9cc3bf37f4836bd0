"""What is performed before anybody asks for it: a short text that somebody has written, and may soon play."""

from __future__ import annotations

from dataclasses import dataclass

from ..take import Take
from . import limits
from .version import Version
from .wire import Made, Source


@dataclass(frozen=True, slots=True)
class Rehearsal:
    """A take of what a page has written."""

    made: Made
    version: Version
    take: Take


def worth_it(source: Source) -> bool:
    """Whether to perform it in case: what takes longer would keep waiting what is asked meanwhile."""
    plain = source.format == "text" and source.recording is None
    return plain and bool(source.script.strip()) and len(source.script) <= limits.REHEARSED
