"""`.azure.json`: viseme events as Azure Speech sends them: an id of 0 to 21 at each offset of 100 ns.

Lost: all but which phone is spoken.
"""

from __future__ import annotations

from pathlib import Path

from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..layout import write_json
from .visemes import Viseme, cues, said

TICKS_PER_SECOND = 10_000_000
SILENCE = 0


def write_azure_json(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write a list `visemes` of `AudioOffset` (ticks) and `VisemeId`; OutputError if nothing is said."""
    events = [
        {"AudioOffset": round(cue.start * TICKS_PER_SECOND), "VisemeId": int(cue.shape)}
        for cue in cues(said(take), _ids, str(SILENCE))
    ]
    write_json(path, {"visemes": events})


def _ids(viseme: Viseme) -> tuple[str, ...]:
    return (str(viseme.azure),)


register(".azure.json", "viseme events as Azure Speech sends them", {"speech"}, write_azure_json)
