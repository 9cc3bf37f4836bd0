"""Skin."""

from __future__ import annotations

from ..brdf import mirrored, schlick
from ..inputs import ALBEDO, CURVATURE, OCCLUSION, SKIN, Batch, Light, Mesh, Pose, Sight, Tables
from ..jit import device, f4, inlined
from ..noise import grain
from ..raster import FloatArray
from ..subsurface import scattered
from ..vec import Vec, add, along, dot, rotate, scale, smooth, tilted, times, unit, weigh
from .folds import bent, creased
from .lit import key_share, lamp_colour, lamp_direction, lamp_share, room_light, warm_edge
from .mouth import past_lips
from .patch import Corners, corners_of, put, towards, weights_of

_DARK = f4(0.004)  # a lamp of which less arrives is left out
_FACING = f4(0.028)  # what skin mirrors head on: index of refraction 1.4
_FRONT = 2  # lamps: those further on stand behind the head
_FLESH = f4(0.85)  # share of a fold's slope that the light scattered below the surface sees
_PORES = f4(6.5 / 0.62)  # grain cells to the millimetre: pores 0.62 mm apart


@device
def shade_skin(
    n: int, batch: Batch, mesh: Mesh, sight: Sight, light: Light, pose: Pose, tables: Tables
) -> None:
    """Colour the patches of bare skin among the first n of a row."""
    for k in range(n):
        t = batch.triangle[k]
        if mesh.surfaces[t] != SKIN:
            continue
        corners, weights = corners_of(mesh.triangles, t), weights_of(batch.weights, k)
        curvature, inner, cloth = weigh(mesh.attributes, corners, weights, CURVATURE)
        if cloth > sight.pixel:
            continue
        p = weigh(mesh.positions, corners, weights, 0)
        normal, view = unit(weigh(mesh.normals, corners, weights, 0)), towards(sight.eye, p)
        colour = _skin(
            mesh,
            light,
            pose,
            tables,
            t,
            corners,
            weights,
            p,
            normal,
            view,
            sight.pixel,
            curvature,
            inner,
            cloth,
        )
        put(batch.colour, k, colour)


@inlined
def _skin(
    mesh: Mesh,
    light: Light,
    pose: Pose,
    tables: Tables,
    t: int,
    corners: Corners,
    weights: Vec,
    p: Vec,
    normal: Vec,
    view: Vec,
    pixel: float,
    curvature: float,
    inner: float,
    cloth: float,
) -> Vec:
    """Return the light from skin: scattered below the surface, glossy on it, dark within the mouth."""
    albedo = weigh(mesh.attributes, corners, weights, ALBEDO)
    free, roughness, strength = weigh(mesh.attributes, corners, weights, OCCLUSION)
    rest = weigh(mesh.rest, corners, weights, 0)
    # Close above the collar its edge takes the light away.
    free *= f4(1) - f4(0.5) * smooth(f4(-7), f4(0), cloth)
    fine, pores = _relief(tables.grain, pose.rotation, rest, normal, pixel, f4(1) - inner)
    soft, bumpy = tilted(normal, scale(pores, f4(0.5))), tilted(normal, pores)
    albedo = scale(albedo, f4(1) + f4(0.025) * fine)
    strength *= f4(1) + f4(0.2) * min(fine, f4(1))
    if mesh.crease_regions[t]:
        folds, deep = creased(tables, mesh, pose, t, corners, weights, rest, normal, dot(normal, view), pixel)
        if deep > f4(0) or dot(folds, folds) > f4(0):
            soft, bumpy = bent(soft, folds, _FLESH), bent(bumpy, folds, f4(1))
        free *= f4(1) - f4(0.7) * deep
        strength *= f4(1) - f4(0.6) * deep
        albedo = times(albedo, (f4(1) - f4(0.22) * deep, f4(1) - f4(0.36) * deep, f4(1) - f4(0.38) * deep))
    shadow = key_share(light, p)
    opened = free
    if inner > f4(0.02):
        seen = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p)
        opened = free + (seen - free) * inner
        shadow *= f4(1) + (seen - f4(1)) * inner
    total = times(albedo, room_light(light.room, soft, opened))
    shine = (f4(0), f4(0), f4(0))
    for k in range(len(light.lamps)):
        direction, colour = lamp_direction(light.lamps, k), lamp_colour(light.lamps, k)
        share = lamp_share(mesh.reach, corners, weights, k, shadow)
        if k >= _FRONT:
            share *= share  # between vertices that see the lamp and such that don't, light leaks
        if share < _DARK:
            continue
        below = scattered(tables.diffuse, dot(soft, direction), curvature)
        total = add(total, times(times(albedo, colour), times(below, warm_edge(share))))
        wide = roughness + light.lamps[k, 6]
        half = add(view, direction)
        at_light, at_half, apart = dot(bumpy, direction), dot(bumpy, half), dot(half, half)
        glint = mirrored(at_light, at_half, apart, wide, _FACING)
        if k >= _FRONT:
            glint *= f4(0.4)  # a lamp behind the head grazes it, where a mirror would outshine all
        elif k == 0:
            glint = f4(0.7) * glint + f4(0.3) * mirrored(at_light, at_half, apart, wide * f4(2.2), _FACING)
        shine = along(shine, colour, glint * share * strength)
    # A rough surface mirrors less along its outline than a smooth one.
    edge = min(schlick(dot(soft, view), _FACING), f4(0.16)) * opened * strength
    shine = along(shine, room_light(light.room, soft, f4(1)), edge * f4(0.8))
    return add(total, shine)


@device
def _relief(
    tile: FloatArray, rotation: FloatArray, rest: Vec, normal: Vec, pixel: float, amount: float
) -> tuple[float, Vec]:
    """Return the pores' height, and how they turn the normal."""
    height, gx, gy, gz = grain(tile, rest, _PORES)
    # Pores smaller than two pixels would flicker as the head moves.
    depth = f4(0.0075) * amount * (f4(1) - smooth(f4(0.22), f4(0.7), pixel))
    slope = rotate(rotation, (gx, gy, gz))
    return height, scale(along(slope, normal, -dot(slope, normal)), -depth)
