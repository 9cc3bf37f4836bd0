"""`.mp4`: video with sound; H.264 (yuv420p) and AAC."""

from __future__ import annotations

from pathlib import Path

from ..export_source import WritableTake, WriteOptions
from ..formats import register
from .film import write_film


def write_mp4(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write all frames; raises as `write_film`."""
    write_film(take, path, options, "mp4")


register(".mp4", "video with sound", {"pixels"}, write_mp4, opaque=True, order=1)
