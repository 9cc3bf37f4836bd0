"""`.png`: one frame, or a contact sheet."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ...core.performance import Performance
from ...errors import InputError
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from .sheet import write_sheet

if TYPE_CHECKING:
    from PIL.PngImagePlugin import PngInfo


def write_png(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the frame nearest to `options.at` seconds, by default the middle one; with `every`, a sheet.

    Raises InputError for a time outside the performance, and as `write_sheet`.
    """
    from PIL import Image

    if options.every is not None:
        write_sheet(take, path, options, options.every)
        return
    index = frame_at(take.performance, options.at)
    for picture in take.pictures(options.size, [index], options.progress):
        Image.fromarray(picture).save(path, format="PNG", pnginfo=srgb())


def srgb() -> PngInfo:
    """Return the chunk that says that colours are sRGB, to be shown as they are."""
    from PIL.PngImagePlugin import PngInfo

    info = PngInfo()
    info.add(b"sRGB", b"\0")
    return info


def frame_at(performance: Performance, seconds: float | None) -> int:
    """Return the index of the frame nearest to a time, the middle frame for None.

    Raises InputError for a time more than half a frame outside the performance.
    """
    count = len(performance.values)
    if seconds is None:
        return count // 2
    index = round(seconds * performance.fps) if abs(seconds) < float("inf") else -1
    if not 0 <= index < count:
        last = float((count - 1) / performance.fps)
        raise InputError(f"--at {seconds:g} is outside the performance; expected 0 to {last:g} seconds")
    return index


register(".png", "one frame, or a sheet of every n-th", {"pixels"}, write_png, reads=("at", "every"), order=4)
