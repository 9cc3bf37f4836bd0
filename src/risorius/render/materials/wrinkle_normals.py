"""Creases in the skin: how wrinkles turn its normal and darken it."""

from __future__ import annotations

import math

from ...machine.kernels.jit import device, f4, i8
from ...machine.kernels.vec import Vec, along, dot, rotate, saturate, unit
from ..grain import grain
from ..inputs import Pose, PosedMesh, Tables
from ..wrinkle_table import DIMPLES, FAINT, FOLD, FURROW, KIND, SHADOW, SHARE
from .shading_sample import Corners

PIT_CELLS = f4(6.5)
"""Cells of the grain to one of its waves."""
_STEEPEST = f4(1.1)
_ROUND = f4(0.32)  # of the furrow's width: half of its round bottom


@device("fast")
def creased(
    tables: Tables,
    mesh: PosedMesh,
    pose: Pose,
    t: int,
    corners: Corners,
    weights: Vec,
    rest: Vec,
    normal: Vec,
    facing: float,
    pixel: float,
) -> tuple[Vec, float]:
    """Return the slope of the folds at a point, in the world, and how deep it lies in creases, 0..1."""
    total, dark = (f4(0), f4(0), f4(0)), f4(0)
    blur = covered_skin(pixel, facing)
    bits, r = mesh.crease_raised[t], i8(0)
    while bits:
        if bits & 1:
            height = _height(mesh, corners, weights, r)
            if height > FAINT:
                slope, deep = _fold(tables, mesh, corners, weights, r, rest, height, blur)
                total = along(total, slope, f4(1))
                dark += deep
        bits >>= 1
        r += 1
    total = rotate(pose.rotation, total)
    return along(total, normal, -dot(total, normal)), saturate(dark)


@device("fast")
def covered_skin(pixel: float, facing: float) -> float:
    """Return the mm of skin that a pixel covers: more where the skin turns away from the camera."""
    return pixel / max(facing, f4(0.25))


@device("fast")
def darkened(shadow: float, height: float) -> float:
    """Return how much of a crease's `shadow` one of this height has."""
    return shadow * saturate(height * f4(1.6))


@device("fast")
def bent(normal: Vec, slope: Vec, share: float) -> Vec:
    """Return a unit normal turned by a share of a slope; the slope is limited to those that light shows."""
    steep = math.sqrt(dot(slope, slope))
    return unit(along(normal, slope, -share / max(f4(1), steep / _STEEPEST)))


@device("fast")
def _height(mesh: PosedMesh, corners: Corners, weights: Vec, r: int) -> float:
    h, (a, b, c) = mesh.crease_height, corners
    height = weights[0] * h[a, r] + weights[1] * h[b, r] + weights[2] * h[c, r]
    return f4(height * mesh.crease_style[r, SHARE])


@device("fast")
def _place(mesh: PosedMesh, corners: Corners, weights: Vec, r: int) -> tuple[float, Vec]:
    """Return phase and its slope at a point of region r."""
    p, (a, b, c), (u, v, w) = mesh.crease_place, corners, weights
    phase = u * p[a, r, 0] + v * p[b, r, 0] + w * p[c, r, 0]
    x = u * p[a, r, 1] + v * p[b, r, 1] + w * p[c, r, 1]
    y = u * p[a, r, 2] + v * p[b, r, 2] + w * p[c, r, 2]
    z = u * p[a, r, 3] + v * p[b, r, 3] + w * p[c, r, 3]
    return phase, (x, y, z)


@device("fast")
def _fold(
    tables: Tables,
    mesh: PosedMesh,
    corners: Corners,
    weights: Vec,
    r: int,
    rest: Vec,
    height: float,
    blur: float,
) -> tuple[Vec, float]:
    """Return the slope at rest of region r, and how dark its crease is."""
    style = mesh.crease_style
    furrow, shadow = style[r, FURROW], style[r, SHADOW]
    if style[r, KIND] == DIMPLES:
        return _dimple(tables, rest, height, furrow, shadow, blur)
    phase, way = _place(mesh, corners, weights, r)
    steep = math.sqrt(dot(way, way)) + f4(1e-6)
    # Distance in mm from the nearest crease, on skin that has none of its own beyond a fold.
    if style[r, KIND] == FOLD:
        rise, deep = overhang(phase / steep, furrow, blur)
    else:
        rise, deep = ridge((phase - math.floor(phase + f4(0.5))) / steep, f4(1) / steep, furrow, blur)
    scale = height * rise / steep
    return (way[0] * scale, way[1] * scale, way[2] * scale), deep * darkened(shadow, height)


@device("fast")
def ridge(d: float, spacing: float, furrow: float, blur: float) -> tuple[float, float]:
    """Return the slope (1/mm) `d` mm from a crease of unit height with round shoulders, and its darkness.

    The darkness is 1 at the bottom.

    h = 0.6·(1 − exp(−|d|/furrow)) + 0.4·sin²(πd/spacing): the tangent breaks at the crease (paper B) and
    is softened over a pixel's width, so that no crease is thinner than a pixel, and over a part of the
    furrow's, so that it is a soft fold with a lit and a shaded side and not a line.
    """
    bottom = _ROUND * furrow
    sharp = math.sqrt(d * d + f4(0.35) * blur * blur + bottom * bottom)
    wide = furrow * f4(0.45) + f4(0.4) * blur
    steep, deep = math.exp(-sharp / wide), math.exp((bottom - sharp) / wide)
    # Nothing is visible if a pixel covers a large part of the spacing.
    seen = f4(1) - saturate((blur / spacing - f4(0.15)) * f4(4))
    turn = math.pi * d / spacing
    rise = f4(0.6) * steep / wide * d / sharp + f4(0.4) * math.pi / spacing * math.sin(f4(2) * turn)
    return rise * seen, deep * seen


@device("fast")
def overhang(d: float, furrow: float, blur: float) -> tuple[float, float]:
    """Return the slope (1/mm) of a fold of unit height whose cheek rises from d = 0 on, and its darkness."""
    soft = f4(0.5) * blur + f4(0.25) * furrow
    # A smooth step replaces the break of the tangent at the crease.
    beyond = f4(0.5) + f4(0.5) * d / math.sqrt(d * d + soft * soft)
    far = max(d, f4(0)) / (f4(1.5) * furrow)
    swell = (f4(1) - far) * math.exp(-far) / (f4(1.5) * furrow)
    near = d / (f4(1.6) * furrow)
    lip = math.exp(-near * near)
    rise = beyond * swell * f4(1.9) - (f4(1) - beyond) * f4(0.22) * lip / furrow
    deep = math.exp(-abs(d + f4(0.1) * furrow) / (f4(0.55) * furrow + f4(0.4) * blur))
    return rise, deep


@device("fast")
def _dimple(
    tables: Tables, rest: Vec, height: float, spacing: float, shadow: float, blur: float
) -> tuple[Vec, float]:
    """Return the slope at rest of pits, and how dark they are."""
    h, gx, gy, gz = grain(tables.grain, rest, PIT_CELLS / spacing)
    steep, deep = pit(h, spacing, blur)
    scale = height * steep
    return (gx * scale, gy * scale, gz * scale), deep * darkened(shadow, height)


@device("fast")
def pit(h: float, spacing: float, blur: float) -> tuple[float, float]:
    """Return the share of the grain's slope that pits have where its height is h, and their darkness."""
    seen = f4(1) - saturate((blur / spacing - f4(0.25)) * f4(3))
    # Pits more than hills, without an edge between: a hard one looks like the peel of an orange.
    return saturate(f4(0.5) - f4(0.5) * h) * f4(0.65) * seen, saturate(-h) * seen
