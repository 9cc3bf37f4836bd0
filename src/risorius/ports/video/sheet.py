"""A contact sheet: every n-th frame with its number (as paper A, Figure 7) and time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ...core.arrays import ByteArray
from ...core.look import Size
from ...errors import InputError
from ..export_source import WritableTake, WriteOptions

if TYPE_CHECKING:
    from PIL.Image import Image as PillowImage

MAX_PICTURES = 600
WIDTH = 240
GAP = 6
LABEL = 22
BACKGROUND = (255, 255, 255)
INK = (30, 30, 30)


def write_sheet(take: WritableTake, path: Path, options: WriteOptions, every: int) -> None:
    """Write frames 0, n, 2n … for n = `every` as PNG, left to right, each with number and seconds.

    Pictures have the proportions of `options.size` and are at most WIDTH wide. Raises as `sheet_frames`.
    """
    indices = sheet_frames(len(take.performance.values), every)
    size = _thumbnail(options.size)
    columns = _columns(len(indices), size)
    sheet = _blank(len(indices), columns, size)
    pictures = take.pictures(size, indices, options.progress)
    for place, (index, picture) in enumerate(zip(indices, pictures, strict=True)):
        row, column = divmod(place, columns)
        corner = (GAP + column * (size[0] + GAP), GAP + row * (size[1] + LABEL))
        _paste(sheet, picture, corner, f"{index} · {float(index / take.performance.fps):.2f} s")
    sheet.save(path, format="PNG")


def sheet_frames(count: int, every: int) -> Sequence[int]:
    """Return the frames to show of `count`.

    Raises InputError if `every` is less than 1 or the sheet would hold more than MAX_PICTURES.
    """
    if every < 1:
        raise InputError(f"--every {every} is out of range; expected 1 or more")
    least = math.ceil(count / MAX_PICTURES)
    if every < least:
        raise InputError(f"--every {every} makes too many pictures; expected {least} or more")
    return range(0, count, every)


def _thumbnail(size: Size) -> Size:
    width = min(WIDTH, size[0])
    return width, max(1, round(width * size[1] / size[0]))


def _columns(count: int, size: Size) -> int:
    """As many columns as make the sheet about 4:3."""
    return max(1, min(count, round(math.sqrt(count * 4 / 3 * (size[1] + LABEL) / (size[0] + GAP)))))


def _blank(count: int, columns: int, size: Size) -> PillowImage:
    from PIL import Image

    rows = math.ceil(count / columns)
    return Image.new("RGB", (GAP + columns * (size[0] + GAP), GAP + rows * (size[1] + LABEL)), BACKGROUND)


def _paste(sheet: PillowImage, picture: ByteArray, corner: tuple[int, int], label: str) -> None:
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(picture)
    sheet.paste(image, corner, image if image.mode == "RGBA" else None)
    ImageDraw.Draw(sheet).text(
        (corner[0] + image.width / 2, corner[1] + image.height + LABEL / 2),
        label,
        fill=INK,
        font=ImageFont.load_default(size=14),
        anchor="mm",
    )
