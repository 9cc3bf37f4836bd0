"""Shading for explaining pictures: plain matter, muscles painted on it, the mesh drawn on it."""

from __future__ import annotations

from ..core.arrays import ByteArray
from ..core.kernels.jit import fast_kernel
from .collect import collect
from .inputs import Batch, Paint, Pose, PosedMesh, SceneLight, Sight, Tables
from .materials.hair import shade_hairs
from .materials.plain import shade_plain
from .shade import resolve, uncover


@fast_kernel
def shade_diagram(
    sight: Sight,
    mesh: PosedMesh,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
    paint: Paint,
    batch: Batch,
    out: ByteArray,
) -> None:
    """Write the picture (height, width, 3) of sRGB bytes."""
    for y in range(out.shape[0]):
        uncover(y, sight, mesh)
        n = collect(y, sight, mesh, batch)
        shade_plain(n, batch, mesh, sight, light, pose, tables, paint)
        shade_hairs(n, batch, mesh)
        resolve(y, n, sight, batch, tables, out)
