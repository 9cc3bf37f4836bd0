"""Shading of diagrams (clay, muscles, wireframe): a plain material with muscles or the mesh drawn on it."""

from __future__ import annotations

from ..core.arrays import ByteArray
from ..machine.kernels.jit import kernel
from .adaptive_samples import collect
from .inputs import Batch, Paint, Pose, PosedMesh, SceneLight, Screen, Tables
from .materials.hair import shade_hairs
from .materials.plain import shade_plain
from .shade import resolve, uncover


@kernel(
    "Screen, PosedMesh, SceneLight, Pose, Tables, Paint, Batch, u1[:, :, :]", arithmetic="fast", wide=True
)
def shade_diagram(
    screen: Screen,
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
        uncover(y, screen, mesh)
        n = collect(y, screen, mesh, batch)
        shade_plain(n, batch, mesh, screen, light, pose, tables, paint)
        shade_hairs(n, batch, mesh)
        resolve(y, n, screen, batch, tables, out)
