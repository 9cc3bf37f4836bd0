"""Deferred shading with adaptive anti-aliasing.

Each pixel looks at its samples in the visibility buffer. Samples that show the same surface at the same depth
form a patch, shaded once, at its middle; so smooth skin costs one evaluation a pixel and outlines as many as
needed. Patches are collected row by row and each material then answers for its own.
"""

from __future__ import annotations

from .inputs import Batch, Light, Mesh, Pose, Sight, Tables
from .jit import device, f4, f8, index, inlined, kernel
from .materials.cloth import shade_cloth
from .materials.eye import shade_eyes
from .materials.hair import shade_hairs
from .materials.mouth import shade_mouth
from .materials.skin import shade_skin
from .raster import BAND, SUBPIXEL, ByteArray, FloatArray, IntArray, rasterize
from .tone import developed, exposed, to_byte
from .vec import Vec, saturate

_SAME_DEPTH = f4(0.003)  # share of the distance within which samples of one surface count as connected


@kernel
def shade(
    sight: Sight, mesh: Mesh, light: Light, pose: Pose, tables: Tables, batch: Batch, out: ByteArray
) -> None:
    """Write the picture (height, width, 3) of sRGB bytes."""
    for y in range(out.shape[0]):
        uncover(y, sight, mesh)
        n = collect(y, sight, mesh, batch)
        shade_skin(n, batch, mesh, sight, light, pose, tables)
        shade_cloth(n, batch, mesh, sight, light, tables)
        shade_hairs(n, batch, mesh)
        shade_eyes(n, batch, mesh, sight, light, pose, tables)
        shade_mouth(n, batch, mesh, sight, light, pose)
        resolve(y, n, sight, batch, tables, out)


@device
def uncover(y: int, sight: Sight, mesh: Mesh) -> None:
    """Draw the band of samples that begins with row y of the picture, if one does."""
    band = BAND // sight.samples
    if y % band == 0:
        top, bottom = y * sight.samples, min((y + band) * sight.samples, sight.ids.shape[0])
        rasterize(
            mesh.xy, mesh.key, mesh.triangles, sight.rows, sight.chunks, top, bottom, sight.depth, sight.ids
        )


@device
def collect(y: int, sight: Sight, mesh: Mesh, batch: Batch) -> int:
    """Find the patches of row y; return how many there are."""
    side, n = sight.samples, 0
    for x in range(sight.background.shape[1]):
        if _whole(x, y, sight, mesh):
            _put(
                n,
                x,
                side * side,
                f4(side) * (f4(x) + f4(0.5)),
                f4(side) * (f4(y) + f4(0.5)),
                sight.ids[y * side, x * side],
                mesh,
                batch,
            )
            n += 1
            continue
        done, bit = 0, 1
        for row in range(y * side, y * side + side):
            for column in range(x * side, x * side + side):
                if sight.ids[index(row), index(column)] >= 0 and done & bit == 0:
                    done |= _gather(n, x, y, row, column, done, sight, mesh, batch)
                    n += 1
                bit <<= 1
    return n


@inlined
def _whole(x: int, y: int, sight: Sight, mesh: Mesh) -> bool:
    """Return whether one surface fills the pixel, without a step in depth."""
    side = sight.samples
    t: int = sight.ids[y * side, x * side]
    if t < 0:
        return False
    surface, depth = mesh.surfaces[t], sight.depth[y * side, x * side]
    nearly = depth * _SAME_DEPTH
    for row in range(y * side, y * side + side):
        for column in range(x * side, x * side + side):
            other = sight.ids[index(row), index(column)]
            if other == t:
                continue
            far = abs(sight.depth[index(row), index(column)] - depth) > nearly
            if far or other < 0 or mesh.surfaces[index(other)] != surface:
                return False
    return True


@inlined
def _put(n: int, x: int, count: int, u: float, v: float, t: int, mesh: Mesh, batch: Batch) -> None:
    """Write patch n: `count` samples of pixel x that show triangle t, their middle at (u, v) in samples."""
    batch.triangle[n] = t
    batch.column[n] = x
    batch.samples[n] = count
    a, b, c = _weights(u, v, t, mesh.triangles, mesh.xy, mesh.key)
    batch.weights[n, 0], batch.weights[n, 1], batch.weights[n, 2] = a, b, c


@inlined
def _gather(
    n: int,
    x: int,
    y: int,
    row: int,
    column: int,
    done: int,
    sight: Sight,
    mesh: Mesh,
    batch: Batch,
) -> int:
    """Write patch n: all samples of pixel (x, y) not `done` that show what this does; return their bits."""
    side, t = sight.samples, sight.ids[row, column]
    surface, depth = mesh.surfaces[t], sight.depth[row, column]
    nearly = depth * _SAME_DEPTH
    members, bit, count, sum_x, sum_y = 0, 1, 0, 0, 0
    for j in range(y * side, y * side + side):
        for i in range(x * side, x * side + side):
            other = sight.ids[index(j), index(i)]
            free = other >= 0 and done & bit == 0
            near = abs(sight.depth[index(j), index(i)] - depth) <= nearly
            if free and near and (other == t or mesh.surfaces[index(other)] == surface):
                members |= bit
                count += 1
                sum_x += i
                sum_y += j
            bit <<= 1
    share = f4(1) / f4(count)
    _put(n, x, count, f4(sum_x) * share + f4(0.5), f4(sum_y) * share + f4(0.5), t, mesh, batch)
    return members


@device
def _weights(x: float, y: float, t: int, triangles: IntArray, xy: IntArray, key: FloatArray) -> Vec:
    """Return where a place (x, y) in samples lies in triangle t, brought into it, in true perspective."""
    a, b, c = index(triangles[t, 0]), index(triangles[t, 1]), index(triangles[t, 2])
    # In double precision: the differences of large products decide whether anything is left to divide by.
    ax, ay = f8(xy[a, 0]), f8(xy[a, 1])
    bx, by = f8(xy[b, 0]) - ax, f8(xy[b, 1]) - ay
    cx, cy = f8(xy[c, 0]) - ax, f8(xy[c, 1]) - ay
    px, py = x * f4(SUBPIXEL) - ax, y * f4(SUBPIXEL) - ay
    area = f8(1) / (bx * cy - by * cx)
    v = saturate(f4((px * cy - py * cx) * area))
    w = min(saturate(f4((bx * py - by * px) * area)), f4(1) - v)
    u, v, w = (f4(1) - v - w) * key[a], v * key[b], w * key[c]
    whole = f4(1) / (u + v + w)
    return u * whole, v * whole, w * whole


@device
def resolve(y: int, n: int, sight: Sight, batch: Batch, tables: Tables, out: ByteArray) -> None:
    """Weigh the patches of each pixel of row y by their samples, and what is left by the background."""
    for x in range(out.shape[1]):
        out[y, x, 0], out[y, x, 1], out[y, x, 2] = (
            sight.empty[y, x, 0],
            sight.empty[y, x, 1],
            sight.empty[y, x, 2],
        )
    whole, k = sight.samples * sight.samples, 0
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
        out[y, x, 0] = to_byte(tables.bytes, r + left * sight.background[y, x, 0])
        out[y, x, 1] = to_byte(tables.bytes, g + left * sight.background[y, x, 1])
        out[y, x, 2] = to_byte(tables.bytes, b + left * sight.background[y, x, 2])
