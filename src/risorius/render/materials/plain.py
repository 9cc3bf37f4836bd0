"""Plain matter for explaining pictures: clay, on which muscles and the mesh may be drawn."""

from __future__ import annotations

import math

from ..brdf import gloss
from ..inputs import (
    ALBEDO,
    EYE_LEFT,
    INNER,
    OCCLUSION,
    SKIN,
    TEETH,
    TONGUE,
    Batch,
    Light,
    Mesh,
    Paint,
    Pose,
    Sight,
    Tables,
)
from ..jit import device, f4, index, inlined
from ..vec import Vec, along, dot, mix, saturate, scale, smooth, sub, times, unit, unrotate, weigh
from .eye import IRIS, lid_distances, lid_shade
from .folds import bent, creased
from .lit import key_share, lamp_colour, lamp_direction, lamp_share, room_light
from .mouth import past_lips
from .patch import Corners, corners_of, put, towards, weights_of

_FACING = f4(0.04)
_FLESH = f4(1.0)
SOFT = f4(0.9)  # mm: half the width of a muscle's soft edge
_FIBRE = f4(2.4)  # mm from fibre to fibre
_TURN = f4(2 * math.pi)
_BALL = (f4(0.66), f4(0.66), f4(0.66))
_RING = (f4(0.16), f4(0.16), f4(0.17))
_PUPIL = f4(0.42)  # radii of the iris
_FAR = f4(20)  # mm: plain eyes have no corners
_LINE = f4(0.55)  # half a line's width in pixels


@device
def shade_plain(
    n: int,
    batch: Batch,
    mesh: Mesh,
    sight: Sight,
    light: Light,
    pose: Pose,
    tables: Tables,
    paint: Paint,
) -> None:
    """Colour the patches of skin, eyes, teeth and tongue among the first n of a row."""
    for k in range(n):
        t = batch.triangle[k]
        surface = mesh.surfaces[t]
        if surface > TONGUE:
            continue
        corners, weights = corners_of(mesh.triangles, t), weights_of(batch.weights, k)
        p = weigh(mesh.positions, corners, weights, 0)
        normal, view = unit(weigh(mesh.normals, corners, weights, 0)), towards(sight.eye, p)
        if surface == SKIN:
            colour = _skin(
                mesh, light, pose, tables, paint, t, corners, weights, p, normal, view, sight.pixel
            )
            line = _line(mesh, paint, t, corners, weights, sight.samples)
            colour = mix(colour, (paint.ink[0], paint.ink[1], paint.ink[2]), line)
        elif surface >= TEETH:
            albedo = weigh(mesh.attributes, corners, weights, ALBEDO)
            deep = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p)
            colour = _matt(mesh, light, corners, weights, p, normal, view, albedo, deep, deep)
        else:
            colour = _ball(mesh, light, pose, surface - EYE_LEFT, corners, weights, p, view)
        put(batch.colour, k, colour)


@inlined
def _skin(
    mesh: Mesh,
    light: Light,
    pose: Pose,
    tables: Tables,
    paint: Paint,
    t: int,
    corners: Corners,
    weights: Vec,
    p: Vec,
    normal: Vec,
    view: Vec,
    pixel: float,
) -> Vec:
    """Return the light from clay: matt, creased where the skin is, with what is painted on it."""
    albedo = weigh(mesh.attributes, corners, weights, ALBEDO)
    free = weigh(mesh.attributes, corners, weights, OCCLUSION)[0]
    inner = weigh(mesh.attributes, corners, weights, INNER)[0]
    if mesh.crease_regions[t]:
        rest = weigh(mesh.rest, corners, weights, 0)
        folds, deep = creased(tables, mesh, pose, t, corners, weights, rest, normal, dot(normal, view), pixel)
        normal = bent(normal, folds, _FLESH)
        free *= f4(1) - f4(0.7) * deep
    glow = (f4(0), f4(0), f4(0))
    if paint.covered[t]:
        albedo, glow = _painted(paint, t, corners, weights, albedo, pixel)
    opened, passing = free, f4(1)
    if inner > f4(0.02):
        seen = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p)
        opened = free + (seen - free) * inner
        passing = f4(1) + (seen - f4(1)) * inner
    lit = _matt(mesh, light, corners, weights, p, normal, view, albedo, opened, passing)
    return along(lit, glow, opened)


@inlined
def _matt(
    mesh: Mesh,
    light: Light,
    corners: Corners,
    weights: Vec,
    p: Vec,
    normal: Vec,
    view: Vec,
    albedo: Vec,
    free: float,
    passing: float,
) -> Vec:
    """Return matt light with a broad, faint gloss of the key lamp."""
    shadow = key_share(light, p) * passing
    total = times(albedo, room_light(light.room, normal, free))
    for k in range(len(light.lamps)):
        direction, colour = lamp_direction(light.lamps, k), lamp_colour(light.lamps, k)
        share = lamp_share(mesh.reach, corners, weights, k, shadow)
        facing = saturate((dot(normal, direction) + f4(0.12)) * f4(1 / 1.12))
        total = along(total, times(albedo, colour), facing * share * (passing if k else f4(1)))
    shine = gloss(normal, view, lamp_direction(light.lamps, 0), f4(0.34), _FACING) * shadow
    return along(total, lamp_colour(light.lamps, 0), shine)


@device
def _painted(
    paint: Paint, t: int, corners: Corners, weights: Vec, albedo: Vec, pixel: float
) -> tuple[Vec, Vec]:
    """Return the albedo under the muscles that cover triangle t, and the glow of those kept down."""
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


@device
def _line(mesh: Mesh, paint: Paint, t: int, corners: Corners, weights: Vec, samples: int) -> float:
    """Return how much of the pixel the lines along the edges of triangle t cover."""
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


@device
def _near(mesh: Mesh, a: int, b: int, c: int, weight: float, samples: int) -> float:
    """Return how much of a pixel the line b–c covers at `weight` of the height of the corner a over it."""
    bx, by = f4(mesh.xy[b, 0]), f4(mesh.xy[b, 1])
    dx, dy = f4(mesh.xy[c, 0]) - bx, f4(mesh.xy[c, 1]) - by
    ax, ay = f4(mesh.xy[a, 0]) - bx, f4(mesh.xy[a, 1]) - by
    height = abs(dx * ay - dy * ax) / math.sqrt(dx * dx + dy * dy + f4(1))
    return saturate(_LINE + f4(0.5) - weight * height / f4(256 * samples))


@inlined
def _ball(
    mesh: Mesh, light: Light, pose: Pose, side: int, corners: Corners, weights: Vec, p: Vec, view: Vec
) -> Vec:
    """Return the light from an eye: a matt ball with a ring for the iris, in the shade of its lids."""
    centre = (pose.eyes[side, 0], pose.eyes[side, 1], pose.eyes[side, 2])
    outward = unit(sub(p, centre))
    local = unrotate(pose.eye_axes[side], outward)
    in_head = unrotate(pose.rotation, outward)
    below, above = lid_distances(pose.lids, pose.lid_span, side, in_head, pose.eye_radius[side])
    shade = lid_shade(below, above, _FAR, _FAR)
    ring = math.sqrt(local[0] * local[0] + local[1] * local[1]) / IRIS
    iris = f4(1) - smooth(f4(0.94), f4(1.06), ring)
    pupil = f4(1) - smooth(_PUPIL - f4(0.05), _PUPIL + f4(0.05), ring)
    albedo = mix(_BALL, _RING, iris if local[2] > f4(0) else f4(0))
    albedo = scale(albedo, f4(1) - f4(0.85) * pupil * iris)
    lit = _matt(mesh, light, corners, weights, p, outward, view, albedo, shade, shade)
    spark = gloss(outward, view, lamp_direction(light.lamps, 0), f4(0.03), _FACING) * shade
    return along(lit, lamp_colour(light.lamps, 0), min(spark, f4(1.2)))
