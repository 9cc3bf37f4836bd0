"""Hairs drawn as ribbons that face the camera."""

from __future__ import annotations

import math

from ..core.arrays import Float32Array, Int8Array, Int32Array
from ..machine.kernels.jit import device, f4, i8, kernel
from ..machine.kernels.vec import Vec, along, at, cross, dot, scale, sub, unit, weigh

WHOLE, NOTHING = (0, 127), (127, -1)
"""First and last point to draw: of a whole hair of any number of points, and of a hair that is not drawn."""
_GOLDEN = f4(0.61803)  # multiples of this, modulo 1, are spread evenly for any number of hairs


@device()
def _frame(
    positions: Float32Array, normals: Float32Array, corners: tuple[int, int, int], place: Vec
) -> tuple[Vec, Vec, Vec]:
    normal = unit(weigh(normals, corners, place, 0))
    edge = sub(at(positions, corners[1]), at(positions, corners[0]))
    edge = unit(along(edge, normal, -dot(edge, normal)))
    return edge, cross(normal, edge), normal


@device()
def _point(curves: Float32Array, s: int, k: int, origin: Vec, frame: tuple[Vec, Vec, Vec]) -> Vec:
    p = along(origin, frame[0], curves[s, k, 0])
    p = along(p, frame[1], curves[s, k, 1])
    return along(p, frame[2], curves[s, k, 2])


@device()
def _collapse(positions: Float32Array, normals: Float32Array, start: int, end: int, place: Vec) -> None:
    """Move vertices of a ribbon to one place, so that it is neither drawn nor lit."""
    for row in range(start, end):
        positions[row, 0], positions[row, 1], positions[row, 2] = place
        normals[row, 0], normals[row, 1], normals[row, 2] = f4(0), f4(0), f4(0)


@device()
def _double(positions: Float32Array, normals: Float32Array, start: int, end: int, like: int) -> None:
    """Move pairs of vertices of a ribbon to the pair `like`, so that the ribbon ends there."""
    for row in range(start, end, 2):
        for side in range(2):
            for column in range(3):
                positions[row + side, column] = positions[like + side, column]
                normals[row + side, column] = f4(0)


@kernel("f4[:, :], f4[:, :], i4[:, :], f4[:, :], f4[:, :, :], f4[:, :], i1[:, :], f4[:], i8, f4, f4")
def ribbons(
    positions: Float32Array,
    normals: Float32Array,
    roots: Int32Array,
    weights: Float32Array,
    curves: Float32Array,
    widths: Float32Array,
    shown: Int8Array,
    eye: Float32Array,
    first: int,
    behind: float,
    least: float,
) -> None:
    """Write the ribbons' vertices into `positions` and their directions into `normals`, from row `first` on.

    Roots are read from the same arrays; `eye` (3,) is the place of the camera. Hairs whose roots face away
    from it, with a cosine below `behind`, are left out; the others are drawn from the first to the last point
    in `shown` (S, 2). If the last comes first, the hair's vertices stay as they are. No hair is drawn
    narrower than `least` mm, because it would break up between samples; instead, some of the narrower hairs
    are left out, so that the others cover the same area.
    """
    strands, points = widths.shape
    camera = (eye[0], eye[1], eye[2])
    for s in range(strands):
        if shown[s, 0] > shown[s, 1]:
            continue
        corners = (roots[s, 0], roots[s, 1], roots[s, 2])
        place = (weights[s, 0], weights[s, 1], weights[s, 2])
        origin = weigh(positions, corners, place, 0)
        frame = _frame(positions, normals, corners, place)
        spread = f4(s) * _GOLDEN
        crowded = (spread - math.floor(spread)) * least > widths[s, 0]
        start, end = i8(shown[s, 0]), min(i8(shown[s, 1]), points - 1)
        row = first + 2 * s * points
        if crowded or start >= end or dot(frame[2], unit(sub(camera, origin))) < behind:
            _collapse(positions, normals, row, row + 2 * points, origin)
            continue
        here = _point(curves, s, start, origin, frame)
        ahead = (f4(0), f4(0), f4(0))
        for k in range(start, end + 1):
            point = here
            if k + 1 < points:
                here = _point(curves, s, k + 1, origin, frame)
                ahead = unit(sub(here, point))
            wide = max(widths[s, k], least) * f4(0.5)
            side = scale(unit(cross(sub(camera, point), ahead)), wide)
            for column in range(3):
                positions[row + 2 * k, column] = point[column] - side[column]
                positions[row + 2 * k + 1, column] = point[column] + side[column]
                normals[row + 2 * k, column] = ahead[column]
                normals[row + 2 * k + 1, column] = ahead[column]
        _double(positions, normals, row, row + 2 * start, row + 2 * start)
        _double(positions, normals, row + 2 * (end + 1), row + 2 * points, row + 2 * end)
