"""`.webm`: video with sound for the web; VP9 and Opus, with alpha before a transparent background."""

from __future__ import annotations

from pathlib import Path

from ..export_source import WritableTake, WriteOptions
from ..formats import register
from .film import write_film


def write_webm(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write all frames; raises as `write_film`."""
    write_film(take, path, options, "webm")


register(".webm", "video with sound for the web, with alpha if asked", {"pixels"}, write_webm, order=2)
