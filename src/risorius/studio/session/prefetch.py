"""A take made in advance: the page has sent a short text that its user may soon play."""

from __future__ import annotations

from dataclasses import dataclass

from ...take import Take
from .. import limits
from ..wire.shared import Source, TakeInputs
from .revision import Revision


@dataclass(frozen=True, slots=True)
class Prefetch:
    """A take of the text that a page shows."""

    inputs: TakeInputs
    version: Revision
    take: Take


def worth_it(source: Source) -> bool:
    """Tell whether to perform it in advance: a longer one would delay the requests that come meanwhile."""
    plain = source.format == "text" and source.recording is None
    return plain and bool(source.script.strip()) and len(source.script) <= limits.LONGEST_PREFETCH
