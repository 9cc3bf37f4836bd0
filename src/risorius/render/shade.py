"""Deferred shading with adaptive anti-aliasing.

Row by row, the samples of the visibility buffer are collected into patches (`collect`); then each material
shades its own.
"""

from __future__ import annotations

from ..core.arrays import ByteArray, Int32Array
from ..machine.kernels.jit import device, f4, index, kernel
from .adaptive_samples import collect
from .draft import find_facets, shade_row, write_patches
from .inputs import Batch, Facets, LinearTriangles, Pose, PosedMesh, SceneLight, Screen, Tables
from .linear import draw_row, find_linear
from .materials.cloth import shade_cloth
from .materials.eye import shade_eyes
from .materials.hair import shade_hairs
from .materials.mouth import shade_mouth
from .materials.skin import shade_skin
from .tone import developed, exposed, to_byte
from .visibility import BAND, rasterize


@kernel("Screen, PosedMesh, SceneLight, Pose, Tables, Batch, u1[:, :, :]", arithmetic="fast", wide=True)
def shade(
    screen: Screen,
    mesh: PosedMesh,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
    batch: Batch,
    out: ByteArray,
) -> None:
    """Write the picture (height, width, 3) of sRGB bytes."""
    for y in range(out.shape[0]):
        uncover(y, screen, mesh)
        n = collect(y, screen, mesh, batch)
        _shade_patches(n, batch, mesh, screen, light, pose, tables)
        resolve(y, n, screen, batch, tables, out)


@kernel(
    "Screen, PosedMesh, SceneLight, Pose, Tables, i4[:], Batch, LinearTriangles, u1[:, :, :]",
    arithmetic="fast",
    wide=True,
)
def shade_linear(
    screen: Screen,
    mesh: PosedMesh,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
    hair_pairs: Int32Array,
    batch: Batch,
    linear: LinearTriangles,
    out: ByteArray,
) -> None:
    """Write the picture (height, width, 3) of four samples a pixel, fast if triangles are linear."""
    find_linear(linear, batch, mesh, screen, light, pose, tables, hair_pairs)
    for y in range(out.shape[0]):
        uncover(y, screen, mesh)
        n = draw_row(y, screen, mesh, linear, batch, tables, out)
        _shade_patches(n, batch, mesh, screen, light, pose, tables)
        resolve_patches(y, n, screen, batch, tables, out)


@kernel(
    "Screen, PosedMesh, SceneLight, Pose, Tables, Batch, Facets, u1[:, :, :]", arithmetic="fast", wide=True
)
def shade_draft(
    screen: Screen,
    mesh: PosedMesh,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
    batch: Batch,
    facets: Facets,
    out: ByteArray,
) -> None:
    """Write the draft of a picture (height, width, 3), a kernel of its own: few runs need both."""
    for y in range(out.shape[0]):
        uncover(y, screen, mesh)
    find_facets(facets, batch, mesh, screen, light, pose, tables)
    for y in range(out.shape[0]):
        n = shade_row(y, screen, mesh, facets, batch, tables, out)
        shade_eyes(n, batch, mesh, screen, light, pose, tables)
        shade_mouth(n, batch, mesh, screen, light, pose)
        write_patches(y, n, batch, tables, out)


@device("fast")
def uncover(y: int, screen: Screen, mesh: PosedMesh) -> None:
    """Draw the band of samples that begins with row y of the picture, if there is one."""
    band = BAND // screen.samples
    if y % band == 0:
        top, bottom = y * screen.samples, min((y + band) * screen.samples, screen.ids.shape[0])
        rasterize(
            mesh.xy,
            mesh.key,
            mesh.triangles,
            screen.order,
            screen.rows,
            screen.chunks,
            top,
            bottom,
            screen.depth,
            screen.ids,
        )


@device("fast", inlined=True)
def _shade_patches(
    n: int,
    batch: Batch,
    mesh: PosedMesh,
    screen: Screen,
    light: SceneLight,
    pose: Pose,
    tables: Tables,
) -> None:
    """Colour the first n patches of a row."""
    shade_skin(n, batch, mesh, screen, light, pose, tables)
    shade_cloth(n, batch, mesh, screen, light, tables)
    shade_hairs(n, batch, mesh)
    shade_eyes(n, batch, mesh, screen, light, pose, tables)
    shade_mouth(n, batch, mesh, screen, light, pose)


@device("fast")
def resolve(y: int, n: int, screen: Screen, batch: Batch, tables: Tables, out: ByteArray) -> None:
    """Write row y: each pixel is the mean of its patches and the background, weighted by samples."""
    for x in range(out.shape[1]):
        out[y, x, 0], out[y, x, 1], out[y, x, 2] = (
            screen.empty[y, x, 0],
            screen.empty[y, x, 1],
            screen.empty[y, x, 2],
        )
    resolve_patches(y, n, screen, batch, tables, out)


@device("fast")
def resolve_patches(y: int, n: int, screen: Screen, batch: Batch, tables: Tables, out: ByteArray) -> None:
    """Write the pixels of row y that have patches."""
    whole, k = screen.samples * screen.samples, 0
    share = f4(1) / f4(whole)
    while k < n:
        x = index(batch.column[k])
        if batch.samples[k] == whole:
            out[y, x, 0] = developed(tables.direct, batch.colour[k, 0])
            out[y, x, 1] = developed(tables.direct, batch.colour[k, 1])
            out[y, x, 2] = developed(tables.direct, batch.colour[k, 2])
            k += 1
            continue
        r, g, b, left = f4(0), f4(0), f4(0), f4(1)
        while k < n and batch.column[k] == x:
            part = f4(batch.samples[k]) * share
            r += part * exposed(tables.film, batch.colour[k, 0])
            g += part * exposed(tables.film, batch.colour[k, 1])
            b += part * exposed(tables.film, batch.colour[k, 2])
            left -= part
            k += 1
        out[y, x, 0] = to_byte(tables.bytes, r + left * screen.background[y, x, 0])
        out[y, x, 1] = to_byte(tables.bytes, g + left * screen.background[y, x, 1])
        out[y, x, 2] = to_byte(tables.bytes, b + left * screen.background[y, x, 2])
