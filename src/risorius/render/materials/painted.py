"""Drawings of diagrams on the skin: muscles along their lines of pull, and the edges of the mesh."""

from __future__ import annotations

import math

from ...looks.muscle_paint import SOFT
from ...machine.kernels.jit import device, f4, index
from ...machine.kernels.vec import Vec, along, mix, saturate, scale, smooth
from ..inputs import Paint, PosedMesh
from .shading_sample import Corners

_FIBRE = f4(2.4)  # mm from fibre to fibre
_TURN = f4(2 * math.pi)
_LINE = f4(0.55)  # half a line's width in pixels


@device("fast")
def painted(
    paint: Paint, t: int, corners: Corners, weights: Vec, albedo: Vec, pixel: float
) -> tuple[Vec, Vec]:
    """Return the albedo with the muscles that cover triangle t, and the glow of suppressed muscles."""
    glow = (f4(0), f4(0), f4(0))
    bits, k = paint.covered[t], index(0)
    (a, b, c), (u, v, w) = corners, weights
    fine = f4(1) - smooth(f4(0.25), f4(0.6), pixel / _FIBRE)
    while bits:
        if bits & 1:
            inside = u * paint.place[a, k, 0] + v * paint.place[b, k, 0] + w * paint.place[c, k, 0]
            way = u * paint.place[a, k, 1] + v * paint.place[b, k, 1] + w * paint.place[c, k, 1]
            fibre = f4(1) + f4(0.42) * fine * math.cos(way / _FIBRE * _TURN)
            colour = (paint.colours[k, 0], paint.colours[k, 1], paint.colours[k, 2])
            share = smooth(-SOFT, SOFT, inside) * paint.colours[k, 3]
            albedo = mix(albedo, scale(colour, fibre * f4(0.85)), share)
            hot = max(colour[0] - f4(0.7), f4(0)) * share
            glow = along(glow, colour, hot * f4(0.35))
        bits >>= 1
        k += index(1)
    return albedo, glow


@device("fast")
def line_share(mesh: PosedMesh, paint: Paint, t: int, corners: Corners, weights: Vec, samples: int) -> float:
    """Return the share of the pixel that the lines along the edges of triangle t cover."""
    share = f4(0)
    if paint.ink[3] > f4(0):
        (a, b, c), (u, v, w) = corners, weights
        share = max(
            paint.edges[t, 0] * _near(mesh, a, b, c, u, samples),
            paint.edges[t, 1] * _near(mesh, b, c, a, v, samples),
            paint.edges[t, 2] * _near(mesh, c, a, b, w, samples),
        )
    opacity: float = paint.ink[3]
    return share * opacity


@device("fast")
def _near(mesh: PosedMesh, a: int, b: int, c: int, weight: float, samples: int) -> float:
    """Return the share of a pixel that line b–c covers, at `weight` of the height of corner a over it."""
    bx, by = f4(mesh.xy[b, 0]), f4(mesh.xy[b, 1])
    dx, dy = f4(mesh.xy[c, 0]) - bx, f4(mesh.xy[c, 1]) - by
    ax, ay = f4(mesh.xy[a, 0]) - bx, f4(mesh.xy[a, 1]) - by
    height = abs(dx * ay - dy * ax) / math.sqrt(dx * dx + dy * dy + f4(1))
    return saturate(_LINE + f4(0.5) - weight * height / f4(256 * samples))
