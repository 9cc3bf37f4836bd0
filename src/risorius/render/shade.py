"""Deferred shading with adaptive anti-aliasing.

Each pixel looks at its samples in the visibility buffer. Samples that show the same surface at the same depth
form a patch, shaded once, at its middle; so smooth skin costs one evaluation a pixel and outlines as many as
needed. Patches are collected row by row and each material then answers for its own.
"""

from __future__ import annotations

import numpy as np

from .inputs import Batch, Light, Mesh, Pose, Sight, Tables
from .jit import BANDS, band_rows, device, f4, kernel, prange
from .materials.cloth import shade_cloth
from .materials.eye import shade_eyes
from .materials.hair import shade_hairs
from .materials.mouth import shade_mouth
from .materials.skin import shade_skin
from .raster import SUBPIXEL, ByteArray
from .tone import exposed, to_byte
from .vec import Vec, saturate

_SAME_DEPTH = f4(0.003)  # share of the distance within which samples of one surface count as connected


@kernel
def shade(sight: Sight, mesh: Mesh, light: Light, pose: Pose, tables: Tables, batch: Batch, out: ByteArray) -> None:
    """Write the picture (height, width, 3) of sRGB bytes."""
    for index in prange(BANDS):
        turn = np.int64(index)  # prange counts without sign, and all below would be compiled a second time
        top, bottom = band_rows(turn, out.shape[0])
        for y in range(top, bottom):
            n = _collect(turn, y, sight, mesh, batch)
            shade_skin(turn, n, batch, mesh, sight, light, pose, tables)
            shade_cloth(turn, n, batch, mesh, sight, light, tables)
            shade_hairs(turn, n, batch, mesh)
            shade_eyes(turn, n, batch, mesh, sight, light, pose, tables)
            shade_mouth(turn, n, batch, mesh, sight, light, pose)
            _resolve(turn, y, n, sight, batch, tables, out)


@device
def _collect(turn: int, y: int, sight: Sight, mesh: Mesh, batch: Batch) -> int:
    """Find the patches of row y; return how many there are."""
    side, n = sight.samples, 0
    for x in range(sight.background.shape[1]):
        if _whole(x, y, sight):
            _put(turn, n, x, side * side, f4(side) * (f4(x) + f4(0.5)), f4(side) * (f4(y) + f4(0.5)),
                 sight.ids[y * side, x * side], mesh, batch)
            n += 1
            continue
        done, bit = 0, 1
        for row in range(y * side, y * side + side):
            for column in range(x * side, x * side + side):
                if sight.ids[row, column] >= 0 and done & bit == 0:
                    done |= _gather(turn, n, x, y, row, column, done, sight, mesh, batch)
                    n += 1
                bit <<= 1
    return n


@device
def _whole(x: int, y: int, sight: Sight) -> bool:
    """Return whether one triangle fills the pixel."""
    side = sight.samples
    t = sight.ids[y * side, x * side]
    for row in range(y * side, y * side + side):
        for column in range(x * side, x * side + side):
            if sight.ids[row, column] != t:
                return False
    return t >= 0


@device
def _put(turn: int, n: int, x: int, count: int, u: float, v: float, t: int, mesh: Mesh, batch: Batch) -> None:
    """Write patch n: `count` samples of pixel x that show triangle t, with their middle at (u, v) in samples."""
    batch.triangle[turn, n] = t
    batch.column[turn, n] = x
    batch.count[turn, n] = count
    a, b, c = _weights(u, v, t, mesh)
    batch.weights[turn, n, 0], batch.weights[turn, n, 1], batch.weights[turn, n, 2] = a, b, c


@device
def _gather(turn: int, n: int, x: int, y: int, row: int, column: int, done: int, sight: Sight, mesh: Mesh,
            batch: Batch) -> int:
    """Write patch n: all samples of pixel (x, y) not yet `done` that show what this one does; return them as bits."""
    side, t = sight.samples, sight.ids[row, column]
    surface, depth = mesh.surfaces[t], sight.depth[row, column]
    nearly = depth * _SAME_DEPTH
    members, bit, count, sum_x, sum_y = 0, 1, 0, 0, 0
    for j in range(y * side, y * side + side):
        for i in range(x * side, x * side + side):
            other = sight.ids[j, i]
            if other >= 0 and done & bit == 0 and abs(sight.depth[j, i] - depth) <= nearly:
                if other == t or mesh.surfaces[other] == surface:
                    members |= bit
                    count += 1
                    sum_x += i
                    sum_y += j
            bit <<= 1
    share = f4(1) / f4(count)
    _put(turn, n, x, count, f4(sum_x) * share + f4(0.5), f4(sum_y) * share + f4(0.5), t, mesh, batch)
    return members


@device
def _weights(x: float, y: float, t: int, mesh: Mesh) -> Vec:
    """Return where a place in the picture (samples) lies in triangle t, brought into it, in true perspective."""
    a, b, c = mesh.triangles[t, 0], mesh.triangles[t, 1], mesh.triangles[t, 2]
    ax, ay = f4(mesh.xy[a, 0]), f4(mesh.xy[a, 1])
    bx, by = f4(mesh.xy[b, 0]) - ax, f4(mesh.xy[b, 1]) - ay
    cx, cy = f4(mesh.xy[c, 0]) - ax, f4(mesh.xy[c, 1]) - ay
    px, py = x * f4(SUBPIXEL) - ax, y * f4(SUBPIXEL) - ay
    area = f4(1) / (bx * cy - by * cx)
    v = saturate((px * cy - py * cx) * area)
    w = min(saturate((bx * py - by * px) * area), f4(1) - v)
    u, v, w = (f4(1) - v - w) * mesh.key[a], v * mesh.key[b], w * mesh.key[c]
    whole = f4(1) / (u + v + w)
    return u * whole, v * whole, w * whole


@device
def _resolve(turn: int, y: int, n: int, sight: Sight, batch: Batch, tables: Tables, out: ByteArray) -> None:
    """Weigh the patches of each pixel of row y by their samples, and what is left by the background."""
    share, k = f4(1) / f4(sight.samples * sight.samples), 0
    for x in range(out.shape[1]):
        r, g, b, left = f4(0), f4(0), f4(0), f4(1)
        while k < n and batch.column[turn, k] == x:
            part = f4(batch.count[turn, k]) * share
            r += part * exposed(tables.film, batch.colour[turn, k, 0])
            g += part * exposed(tables.film, batch.colour[turn, k, 1])
            b += part * exposed(tables.film, batch.colour[turn, k, 2])
            left -= part
            k += 1
        out[y, x, 0] = to_byte(tables.bytes, r + left * sight.background[y, x, 0])
        out[y, x, 1] = to_byte(tables.bytes, g + left * sight.background[y, x, 1])
        out[y, x, 2] = to_byte(tables.bytes, b + left * sight.background[y, x, 2])
