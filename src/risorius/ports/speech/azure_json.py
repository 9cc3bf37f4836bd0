"""`.azure.json`: viseme events as Azure Speech sends them: an id of 0 to 21 at each offset of 100 ns.

21 lasts as long as our own lips are sealed. Lost: all but which phone is spoken.
"""

from __future__ import annotations

from pathlib import Path

from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..layout import write_json
from .visemes import Viseme, shown_cues

TICKS_PER_SECOND = 10_000_000
SILENCE, CLOSED = 0, 21


def write_azure_json(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write a list `visemes` of `AudioOffset` (ticks) and `VisemeId`; OutputError if nothing is said."""
    events = [
        {"AudioOffset": round(cue.start * TICKS_PER_SECOND), "VisemeId": int(cue.shape)}
        for cue in shown_cues(take, _ids, str(SILENCE), str(CLOSED))
    ]
    write_json(path, {"visemes": events})


def _ids(viseme: Viseme) -> tuple[str, ...]:
    return (str(viseme.azure),)


register(
    ".azure.json", "viseme events as Azure Speech sends them", {"speech"}, write_azure_json, uses=("curves",)
)
