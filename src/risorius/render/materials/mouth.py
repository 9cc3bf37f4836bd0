"""The inside of the mouth: teeth, gums, tongue, and how little light comes past the lips."""

from __future__ import annotations

import math

from ...core.arrays import Float32Array
from ...looks.attributes import ALBEDO, OCCLUSION, TEETH, TONGUE
from ...machine.kernels.jit import device, f4, kernel
from ...machine.kernels.vec import (
    Vec,
    along,
    dot,
    mix,
    saturate,
    scale,
    smooth,
    sub,
    times,
    unit,
    unrotate,
    weigh,
)
from ..brdf import gloss
from ..inputs import Batch, Pose, PosedMesh, SceneLight, Screen
from .lit import ambient_light, key_share, lamp_colour, lamp_direction
from .shading_sample import Corners, corners_of, put, towards, weights_of

LIP_STEPS = 32
FRONT = 2  # lamps; the others stand behind the head
GLOSS = f4(0.03)
_DEPTH = f4(1 / 30)  # 1/mm: cheeks and palate absorb half of the light
_GLOW = f4(0.19)  # share of light that lips and cheeks let through to the flesh behind them
WARM = f4(0.95), f4(0.76), f4(0.70)  # of the light that flesh in the mouth has reflected before
IN_FLESH = f4(0.24), f4(0.11), f4(0.10)  # of a tooth's light: as dark as the lining behind it
AROUND = f4(2.0), f4(1.75), f4(1.6)  # light from all sides of the mouth has its lining's colour
_NEAR, _FAR = f4(6), f4(42)  # mm behind the lips; the lamps' light lessens between them
FAUCES = f4(35)  # mm behind the lips; the lining is drawn further back, but a mouth is not deeper


@device("fast")
def past_lips(
    rotation: Float32Array, pivot: Float32Array, lips: Float32Array, span: Float32Array, p: Vec
) -> float:
    """Return the share of light, 0..1, that enters past the lips, reaches a point in the mouth, and leaves.

    The slit of the lips counts as an endless strip, once at the point's own x and, for slanting light, once
    halfway to the middle. Light leaves by the way it enters, so depth darkens twice.
    """
    x, y, z = unrotate(rotation, sub(p, (pivot[0], pivot[1], pivot[2])))
    x, y, z = x + pivot[0], y + pivot[1], z + pivot[2]
    front: float = lips[LIP_STEPS // 2, 1]
    z = max(z, front - FAUCES)
    return past_strips(_strip(lips, span, x, y, z), _strip(lips, span, x * f4(0.5), y, z), front - z)


@device("fast")
def past_strips(own: float, halfway: float, behind: float) -> float:
    """Return the share of light that enters through the slit's two strips and leaves, `behind` mm in."""
    seen = max(own, f4(0.75) * halfway)
    deep = max(behind, f4(0)) * _DEPTH
    seen /= f4(1) + deep * deep
    share: float = min(f4(2.3) * seen, f4(1)) * (f4(0.4) + f4(0.6) * seen)
    return share


@device("fast")
def lamps_past_lips(rotation: Float32Array, pivot: Float32Array, lips: Float32Array, p: Vec) -> float:
    """Return the share 0..1 of the lamps' light in the mouth that goes as deep as a point."""
    behind: float = lips[LIP_STEPS // 2, 1] - unrotate(rotation, sub(p, (pivot[0], pivot[1], pivot[2])))[2]
    return lamps_behind(behind - pivot[2])


@device("fast")
def lamps_behind(behind: float) -> float:
    """Return the share 0..1 of the lamps' light in the mouth that goes `behind` mm deep."""
    return f4(1) - f4(0.8) * smooth(_NEAR, _FAR, behind)


@device("fast")
def spread_in_flesh(deep: float) -> float:
    """Return the share of light from flesh where the share `deep` arrives: some comes through it."""
    root = math.sqrt(deep)
    spread: float = _GLOW + (f4(1) - _GLOW) * root * (f4(0.35) + f4(0.65) * root)
    return spread


@device("fast")
def entering_light(light: SceneLight, rotation: Float32Array) -> Vec:
    """Return the lamps' light on an open mouth, warm with the colour of the flesh that spreads it within."""
    total: Vec = (f4(0), f4(0), f4(0))
    ahead = _ahead(rotation)
    for k in range(min(len(light.lamps), FRONT)):
        total = along(
            total, lamp_colour(light.lamps, k), saturate(dot(ahead, lamp_direction(light.lamps, k)))
        )
    return times(total, WARM)


@device("fast")
def _ahead(rotation: Float32Array) -> Vec:
    return rotation[0, 2], rotation[1, 2], rotation[2, 2]


@device("fast")
def _strip(lips: Float32Array, span: Float32Array, x: float, y: float, z: float) -> float:
    """Return the form factor of the slit over x: half the difference of the sines towards its two edges."""
    left: float = span[0]
    right: float = span[1]
    place = saturate((x - left) / (right - left)) * f4(LIP_STEPS - 1.001)
    i = int(place)
    s = place - f4(i)
    top, top_z = _edge(lips, i, s, 0)
    low, low_z = _edge(lips, i, s, 2)
    return strip_share(x, y, z, left, right, top, top_z, low, low_z)


@device("fast")
def strip_share(
    x: float,
    y: float,
    z: float,
    left: float,
    right: float,
    top: float,
    top_z: float,
    low: float,
    low_z: float,
) -> float:
    """Return the form factor at a place of a slit from `left` to `right` with the edges y and z over it."""
    up, down = top - y, low - y
    ahead = max(f4(0.5) * (top_z + low_z) - z, f4(0.3))
    up_sine = up / math.sqrt(up * up + ahead * ahead)
    down_sine = down / math.sqrt(down * down + ahead * ahead)
    beside = max(max(left - x, x - right), f4(0))
    return saturate(f4(0.5) * (up_sine - down_sine)) * ahead / (ahead + f4(2) * beside)


@device("fast")
def _edge(lips: Float32Array, i: int, s: float, column: int) -> tuple[float, float]:
    y, z = lips[i, column], lips[i, column + 1]
    return y + (lips[i + 1, column] - y) * s, z + (lips[i + 1, column + 1] - z) * s


@kernel("f4[:, :], f4, f4, f4, b1, f4[:]", arithmetic="fast")
def past_open_lips(
    points: Float32Array, front: float, top: float, low: float, teeth: bool, share: Float32Array
) -> None:
    """Write the share (n,) of light, 0..1, that reaches points (n, 3) of a head at rest past open lips.

    They are an endless slit at the depth `front` between the heights `top` and `low`, mm. With `teeth` it is
    what comes out of teeth there.
    """
    for k in range(len(points)):
        y, z = points[k, 1], points[k, 2]
        seen = strip_share(f4(0), y, z, f4(0), f4(0), top, front, low, front)
        deep = past_strips(seen, seen, front - z)
        share[k] = min(spread_in_teeth(deep), f4(1)) if teeth else deep


@device("fast")
def shade_mouth(n: int, batch: Batch, mesh: PosedMesh, screen: Screen, light: SceneLight, pose: Pose) -> None:
    """Colour the patches of teeth, gums and tongue among the first n of a row."""
    for k in range(n):
        t = batch.triangle[k]
        if mesh.surfaces[t] == TEETH or mesh.surfaces[t] == TONGUE:
            corners, weights = corners_of(mesh.triangles, t), weights_of(batch.weights, k)
            p = weigh(mesh.positions, corners, weights, 0)
            normal, view = unit(weigh(mesh.normals, corners, weights, 0)), towards(screen.eye, p)
            put(
                batch.colour,
                k,
                _wet(mesh, light, pose, mesh.surfaces[t], corners, weights, p, normal, view),
            )


@device("fast", inlined=True)
def _wet(
    mesh: PosedMesh,
    light: SceneLight,
    pose: Pose,
    surface: int,
    corners: Corners,
    weights: Vec,
    p: Vec,
    normal: Vec,
    view: Vec,
) -> Vec:
    """Return the light from teeth, gums and tongue: wet, and dark with their depth behind the lips."""
    albedo = weigh(mesh.attributes, corners, weights, ALBEDO)
    free, roughness, strength = weigh(mesh.attributes, corners, weights, OCCLUSION)
    deep = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p) * free
    if surface == TEETH:
        deep = spread_in_teeth(deep)
        albedo = times(albedo, reddened(deep))
    else:
        deep = spread_in_flesh(deep)
    shadow = key_share(light, p)
    around = times(ambient_light(light.ambient, normal, f4(1)), AROUND)
    total = times(albedo, scale(around, deep))
    if surface == TONGUE:
        share = towards_lips(dot(normal, _ahead(pose.rotation))) * deep
        share *= lamps_past_lips(pose.rotation, pose.pivot, pose.lips, p)
        total = along(total, times(albedo, entering_light(light, pose.rotation)), share)
    for k in range(min(len(light.lamps), FRONT)):
        direction, colour = lamp_direction(light.lamps, k), lamp_colour(light.lamps, k)
        arriving = deep * (shadow if k == 0 else f4(1))
        if surface == TEETH:
            total = along(total, times(albedo, colour), tooth_share(dot(normal, direction)) * arriving)
        total = along(total, colour, gloss(normal, view, direction, roughness, GLOSS) * strength * arriving)
    return total


@device("fast")
def spread_in_teeth(deep: float) -> float:
    """Return the share of light from a tooth where the share `deep` arrives.

    Light that enters a tooth comes out of it and its neighbours again. What arrives deep in the mouth is the
    flesh's own light, which reaches teeth as it reaches their surroundings: they are not black there.
    """
    root = math.sqrt(deep)
    spread = min(root * (f4(0.8) + f4(0.7) * root), f4(1.15))
    return _GLOW + (spread - _GLOW) * smooth(f4(0), f4(0.12), deep)


@device("fast")
def reddened(deep: float) -> Vec:
    """Return a tooth's effective albedo: the redder, the more of the light has met flesh before.

    Where no light comes past the lips a tooth is as dark as flesh: all its light has met flesh often.
    """
    pale = min(f4(0.2) + deep, f4(1))
    red = mix((f4(1), f4(0.72), f4(0.62)), (f4(1), f4(1), f4(1)), pale)
    return times(red, mix(IN_FLESH, (f4(1), f4(1), f4(1)), smooth(_GLOW, f4(2.5) * _GLOW, deep)))


@device("fast")
def tooth_share(cosine: float) -> float:
    """Return the share of a lamp's light on a tooth: it goes round its edges."""
    return saturate((cosine + f4(0.4)) * f4(1 / 1.4))


@device("fast")
def towards_lips(cosine: float) -> float:
    """Return the light past the lips that reaches flesh: directly, and again from the flesh around it."""
    return cosine * f4(0.7) + f4(0.7)
