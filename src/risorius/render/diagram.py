"""Shading for explaining pictures: plain matter, muscles painted on it, the mesh drawn on it."""

from __future__ import annotations

from .inputs import Batch, Light, Mesh, Paint, Pose, Sight, Tables
from .jit import BANDS, band_rows, i8, kernel, prange
from .materials.hair import shade_hairs
from .materials.plain import shade_plain
from .raster import ByteArray
from .shade import collect, resolve


@kernel
def shade_diagram(
    sight: Sight,
    mesh: Mesh,
    light: Light,
    pose: Pose,
    tables: Tables,
    paint: Paint,
    batch: Batch,
    out: ByteArray,
) -> None:
    """Write the picture (height, width, 3) of sRGB bytes."""
    for band in prange(BANDS):
        turn = i8(band)
        top, bottom = band_rows(turn, out.shape[0])
        for y in range(top, bottom):
            n = collect(turn, y, sight, mesh, batch)
            shade_plain(turn, n, batch, mesh, sight, light, pose, tables, paint)
            shade_hairs(turn, n, batch, mesh)
            resolve(turn, y, n, sight, batch, tables, out)
