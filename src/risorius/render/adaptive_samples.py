"""Collect the samples of a row of pixels into patches: the adaptive part of anti-aliasing.

Samples of one pixel that show the same surface at the same depth form a patch, which is shaded once, at its
middle. Smooth skin costs one evaluation for each pixel; a pixel on an outline costs one for each patch.
"""

from __future__ import annotations

from ..core.arrays import Float32Array, Int32Array
from ..machine.kernels.jit import device, f4, f8, index
from ..machine.kernels.vec import Vec, at, dot, saturate
from .inputs import Batch, PosedMesh, Screen
from .raster import SUBPIXEL

_SAME_DEPTH = f4(0.003)  # share of the distance within which samples of one surface count as connected
_SAME_WAY = f4(0.5)  # least cosine between normals of connected samples: lips that touch are two surfaces


@device("fast")
def collect(y: int, screen: Screen, mesh: PosedMesh, batch: Batch) -> int:
    """Find the patches of row y; return how many there are."""
    if screen.samples == 2:
        return _collect(y, 2, screen, mesh, batch)  # loops over a constant number are unrolled
    return _collect(y, screen.samples, screen, mesh, batch)


@device("fast", inlined=True)
def _collect(y: int, side: int, screen: Screen, mesh: PosedMesh, batch: Batch) -> int:
    n = 0
    for x in range(screen.background.shape[1]):
        n = collect_pixel(n, x, y, side, screen, mesh, batch)
    return n


@device("fast", inlined=True)
def collect_pixel(n: int, x: int, y: int, side: int, screen: Screen, mesh: PosedMesh, batch: Batch) -> int:
    """Write the patches of a pixel, from patch n on; return the number of the next patch."""
    middle = f4(0.5) * f4(side)
    t, uniform, waiting = _survey(x, y, side, screen)
    if uniform:
        if t >= 0:
            u, v = f4(x * side) + middle, f4(y * side) + middle
            put_patch(n, x, side * side, u, v, t, mesh, batch)
            n += 1
    else:
        while waiting:
            waiting &= ~_gather(n, x, y, side, waiting, screen, mesh, batch)
            n += 1
    return n


@device("fast", inlined=True)
def _survey(x: int, y: int, side: int, screen: Screen) -> tuple[int, bool, int]:
    """Return the first sample's triangle, whether all samples show it, and a bit for each sample in use."""
    first: int = screen.ids[index(y * side), index(x * side)]
    uniform, some, bit = True, 0, 1
    for j in range(side):
        for i in range(side):
            t = screen.ids[index(y * side + j), index(x * side + i)]
            uniform &= t == first
            some |= bit if t >= 0 else 0
            bit <<= 1
    return first, uniform, some


@device("fast", inlined=True)
def _gather(
    n: int, x: int, y: int, side: int, waiting: int, screen: Screen, mesh: PosedMesh, batch: Batch
) -> int:
    """Write patch n, the samples among the bits `waiting` that belong to the first; return their bits.

    The loop has no branches, because the processor could not predict which samples belong together.
    """
    first = 0
    while (waiting >> first) & 1 == 0:
        first += 1
    row, column = index(y * side + first // side), index(x * side + first % side)
    t, depth = screen.ids[row, column], screen.depth[row, column]
    surface, nearly = mesh.surfaces[index(t)], depth * _SAME_DEPTH
    way = at(mesh.normals, mesh.triangles[index(t), 0])
    members, bit, count, sum_x, sum_y = 0, 1, 0, 0, 0
    for j in range(side):
        for i in range(side):
            row, column = index(y * side + j), index(x * side + i)
            other = screen.ids[row, column]
            near = abs(screen.depth[row, column] - depth) <= nearly
            shown = index(max(other, 0))
            level = dot(way, at(mesh.normals, mesh.triangles[shown, 0])) > _SAME_WAY
            alike = (other == t) | ((mesh.surfaces[shown] == surface) & level)
            one = 1 if (waiting & bit != 0) & near & alike else 0
            members |= bit * one
            count, sum_x, sum_y = count + one, sum_x + i * one, sum_y + j * one
            bit <<= 1
    share = f4(1) / f4(count)
    u = f4(x * side) + f4(sum_x) * share + f4(0.5)
    v = f4(y * side) + f4(sum_y) * share + f4(0.5)
    put_patch(n, x, count, u, v, t, mesh, batch)
    return members


@device("fast", inlined=True)
def put_patch(n: int, x: int, count: int, u: float, v: float, t: int, mesh: PosedMesh, batch: Batch) -> None:
    """Write patch n: `count` samples of pixel x that show triangle t, their middle at (u, v) in samples."""
    batch.triangle[n] = t
    batch.column[n] = x
    batch.samples[n] = count
    a, b, c = weights_at(u, v, t, mesh.triangles, mesh.xy, mesh.key)
    batch.weights[n, 0], batch.weights[n, 1], batch.weights[n, 2] = a, b, c


@device("fast")
def weights_at(x: float, y: float, t: int, triangles: Int32Array, xy: Int32Array, key: Float32Array) -> Vec:
    """Return the weights of a place (x, y) in samples in triangle t, clipped to it, in true perspective."""
    a, b, c = index(triangles[t, 0]), index(triangles[t, 1]), index(triangles[t, 2])
    # In double precision: the area is a difference of large products.
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
