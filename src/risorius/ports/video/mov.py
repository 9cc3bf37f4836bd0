"""`.mov`: video with sound for editing; ProRes 4444 and PCM, with alpha before a transparent background."""

from __future__ import annotations

from pathlib import Path

from ..export_source import WritableTake, WriteOptions
from ..formats import register
from .film import write_film


def write_mov(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write all frames; raises as `write_film`."""
    write_film(take, path, options, "mov")


register(".mov", "video with sound for editing, with alpha if asked", {"pixels"}, write_mov, order=3)
