"""The eye: a wet sphere with an iris behind a clear cornea, in the shade of its lids."""

from __future__ import annotations

import math

from ...core.arrays import Float32Array
from ...core.kernels.jit import f4, fast_device, fast_inlined
from ...core.kernels.vec import (
    Vec,
    add,
    along,
    cross,
    dot,
    mix,
    rotate,
    saturate,
    scale,
    smooth,
    sub,
    times,
    unit,
    unrotate,
    weigh,
)
from ...looks.attributes import EYE_LEFT
from ...looks.eyeball import IRIS
from ..brdf import gloss, schlick
from ..grain import grain
from ..inputs import Batch, Pose, PosedMesh, SceneLight, Screen, Tables
from .lit import ambient_light, key_share, lamp_colour, lamp_direction
from .patch import corners_of, put, towards, weights_of

LID_STEPS = 32
_FRONT = 2  # lamps; the others stand behind the head
_LIMBUS = f4(0.045)  # half the width of its soft edge
_CORNEA = f4(0.46)  # centre of the cornea's sphere on the axis, in radii of the eye
_DEPTH = f4(0.075)  # of the iris behind the limbus, in radii of the eye
_REFRACTION = f4(1 / 1.336)
_WHITE = (f4(0.62), f4(0.57), f4(0.53))
_PINK = (f4(0.56), f4(0.25), f4(0.21))
_FLESH = (f4(0.50), f4(0.185), f4(0.155))  # the caruncle, in the inner corner


@fast_device
def shade_eyes(
    n: int, batch: Batch, mesh: PosedMesh, screen: Screen, light: SceneLight, pose: Pose, tables: Tables
) -> None:
    """Colour the patches of the eyes among the first n of a row."""
    for k in range(n):
        t = batch.triangle[k]
        side = mesh.surfaces[t] - EYE_LEFT
        if side == 0 or side == 1:
            corners = corners_of(mesh.triangles, t)
            p = weigh(mesh.positions, corners, weights_of(batch.weights, k), 0)
            put(batch.colour, k, _eye(light, pose, tables, side, p, towards(screen.eye, p)))


@fast_inlined
def _eye(light: SceneLight, pose: Pose, tables: Tables, side: int, p: Vec, view: Vec) -> Vec:
    """Return the light from the eye `side` (0 left, 1 right) at p."""
    centre = (pose.eyes[side, 0], pose.eyes[side, 1], pose.eyes[side, 2])
    outward = unit(sub(p, centre))
    local = unrotate(pose.eye_axes[side], outward)
    in_head = unrotate(pose.rotation, outward)
    radius = pose.eye_radius[side]
    below, above = lid_distances(pose.lids, pose.lid_span, side, in_head, radius)
    inner, outer = _corner_distances(pose.lid_span, side, in_head, radius)
    shade = lid_shade(below, above, inner, outer)
    ring = math.sqrt(local[0] * local[0] + local[1] * local[1])
    iris_share = f4(0)
    if local[2] > f4(0):
        iris_share = f4(1) - smooth(IRIS - _LIMBUS, IRIS + _LIMBUS, ring)
    shadow = key_share(light, p) * shade
    total = (f4(0), f4(0), f4(0))
    if iris_share < f4(1):
        total = _sclera(light, tables, local, outward, radius, above, inner, outer, shade, shadow)
    facing = outward
    if iris_share > f4(0):
        bulge = unit((local[0], local[1], local[2] - _CORNEA))
        facing = rotate(pose.eye_axes[side], bulge)
        facing = unit(mix(outward, facing, iris_share))
        total = mix(total, _iris(light, pose, tables, side, local, facing, view, shade, shadow), iris_share)
    return add(
        total, _wet(light.lamps, light.ambient, facing, outward, view, shade, shadow, below, above, inner)
    )


@fast_device
def lid_distances(
    lids: Float32Array, span: Float32Array, side: int, in_head: Vec, radius: float
) -> tuple[float, float]:
    """Return mm below the upper and above the lower lid's margin."""
    low, high = span[side, 0], span[side, 1]
    place = saturate((in_head[0] * radius - low) / (high - low)) * f4(LID_STEPS - 1.001)
    i = int(place)
    s = place - f4(i)
    upper = lids[side, i, 0] + (lids[side, i + 1, 0] - lids[side, i, 0]) * s
    lower = lids[side, i, 1] + (lids[side, i + 1, 1] - lids[side, i, 1]) * s
    y = in_head[1] * radius
    return max(upper - y, f4(0)), max(y - lower, f4(0))


@fast_device
def _corner_distances(span: Float32Array, side: int, in_head: Vec, radius: float) -> tuple[float, float]:
    """Return mm across from the inner and from the outer corner of the lids."""
    x = in_head[0] * radius
    first, second = max(x - span[side, 0], f4(0)), max(span[side, 1] - x, f4(0))
    return (first, second) if side == 0 else (second, first)


@fast_device
def lid_shade(below: float, above: float, inner: float, outer: float) -> float:
    """Return the share of light, 0..1, that lids, lashes and corners of the eye let through."""
    upper = f4(1) - f4(0.52) * math.exp(-below * f4(0.75)) - f4(0.30) * math.exp(-below * f4(0.22))
    lower = f4(1) - f4(0.38) * math.exp(-above * f4(0.9))
    corners = (f4(1) - f4(0.42) * math.exp(-inner * f4(0.34))) * (
        f4(1) - f4(0.5) * math.exp(-outer * f4(0.34))
    )
    return upper * lower * corners


@fast_inlined
def _sclera(
    light: SceneLight,
    tables: Tables,
    local: Vec,
    normal: Vec,
    radius: float,
    above: float,
    inner: float,
    outer: float,
    shade: float,
    shadow: float,
) -> Vec:
    """Return the light scattered by the white of the eye: redder and veined to the corners; the caruncle."""
    x, y, z = scale(local, radius)
    vein = abs(grain(tables.grain, (x * f4(0.45), y, z), f4(2.6))[0])
    near = math.exp(-inner * f4(0.14)) + f4(0.8) * math.exp(-outer * f4(0.16))
    vein = (f4(1) - smooth(f4(0), f4(0.16), vein)) * near
    red = f4(0.46) * math.exp(-inner * f4(0.30)) + f4(0.34) * math.exp(-outer * f4(0.3))
    red += f4(0.30) * math.exp(-above * f4(1.1)) + f4(0.42) * vein
    albedo = mix(_WHITE, _PINK, saturate(red))
    albedo = mix(albedo, _FLESH, f4(1) - smooth(f4(0.7), f4(2.5), inner))
    total = times(albedo, scale(ambient_light(light.ambient, normal, shade), f4(0.95)))
    for k in range(min(len(light.lamps), _FRONT)):
        wrapped = saturate((dot(normal, lamp_direction(light.lamps, k)) + f4(0.4)) * f4(1 / 1.4))
        total = along(
            total, times(albedo, lamp_colour(light.lamps, k)), wrapped * (shadow if k == 0 else shade)
        )
    return total


@fast_inlined
def _iris(
    light: SceneLight,
    pose: Pose,
    tables: Tables,
    side: int,
    local: Vec,
    facing: Vec,
    view: Vec,
    shade: float,
    shadow: float,
) -> Vec:
    """Return the light from the iris, seen and lit through the cornea, which gathers it opposite the lamp."""
    cosine = dot(facing, view)
    bent = math.sqrt(f4(1) - _REFRACTION * _REFRACTION * (f4(1) - cosine * cosine))
    inward = along(scale(view, -_REFRACTION), facing, _REFRACTION * cosine - bent)
    ray = unrotate(pose.eye_axes[side], inward)
    plane = math.sqrt(f4(1) - IRIS * IRIS) - _DEPTH
    way = (plane - local[2]) / min(ray[2], f4(-0.1))
    x, y = (local[0] + ray[0] * way) / IRIS, (local[1] + ray[1] * way) / IRIS
    distance = math.sqrt(x * x + y * y)
    albedo = _iris_colour(tables.iris, light.pupil, x, y, distance)
    axis = (pose.eye_axes[side, 0, 2], pose.eye_axes[side, 1, 2], pose.eye_axes[side, 2, 2])
    total = times(albedo, scale(ambient_light(light.ambient, axis, shade), f4(1.1)))
    for k in range(min(len(light.lamps), _FRONT)):
        lamp = unrotate(pose.eye_axes[side], lamp_direction(light.lamps, k))
        gathered = saturate(f4(0.62) - f4(0.75) * (x * lamp[0] + y * lamp[1]) * saturate(distance * f4(1.4)))
        arriving = (shadow if k == 0 else shade) * saturate(lamp[2] + f4(0.2))
        total = along(total, times(albedo, lamp_colour(light.lamps, k)), gathered * arriving * f4(1.35))
    return total


@fast_device
def _iris_colour(image: Float32Array, pupil: float, x: float, y: float, distance: float) -> Vec:
    """Return the albedo at a place in the iris' plane (radius 1): pupil, fibres, dark limbus."""
    rings, angles = image.shape[0], image.shape[1]
    ring = saturate((distance - pupil) / (f4(1) - pupil)) * f4(rings - 1.001)
    turn = (math.atan2(y, x) * f4(0.15915494) + f4(0.5)) * f4(angles)
    i, j = int(ring), int(turn)
    s, t = ring - f4(i), turn - f4(j)
    a, b = j % angles, (j + 1) % angles
    low = mix(_texel(image, i, a), _texel(image, i, b), t)
    high = mix(_texel(image, i + 1, a), _texel(image, i + 1, b), t)
    return scale(mix(low, high, s), smooth(pupil - f4(0.03), pupil + f4(0.045), distance))


@fast_device
def _texel(image: Float32Array, i: int, j: int) -> Vec:
    return image[i, j, 0], image[i, j, 1], image[i, j, 2]


@fast_device
def _wet(
    lamps: Float32Array,
    ambient: Float32Array,
    facing: Vec,
    outward: Vec,
    view: Vec,
    shade: float,
    shadow: float,
    below: float,
    above: float,
    inner: float,
) -> Vec:
    """Return what the tear film mirrors: lamps, ambient light, the lower lid's rim and the caruncle."""
    # A mirror shows the lid above it rather than its shadow.
    free = smooth(f4(0.3), f4(1.6), below) * (f4(0.5) + f4(0.5) * shade)
    total = scale(ambient_light(ambient, facing, f4(1)), schlick(dot(facing, view), f4(0.03)) * free)
    back = along(scale(view, f4(-1)), facing, f4(2) * dot(facing, view))
    for k in range(min(len(lamps), _FRONT)):
        direction, colour = lamp_direction(lamps, k), lamp_colour(lamps, k)
        size = f4(0.23) if k == 0 else f4(0.26)
        bright = f4(1.9) if k == 0 else f4(0.25)
        total = along(total, colour, _window(back, direction, size) * free * bright)
    line = unit(add(outward, (f4(0), f4(0.8), f4(0))))
    tears = smooth(f4(0), f4(0.22), above) * (f4(1) - smooth(f4(0.35), f4(0.8), above))
    flesh = f4(1) - smooth(f4(1.2), f4(3.2), inner)
    key = lamp_direction(lamps, 0)
    glint = f4(0.045) + gloss(line, view, key, f4(0.16), f4(0.05))
    moist = gloss(unit(add(outward, (f4(0), f4(0.2), f4(0)))), view, key, f4(0.10), f4(0.05))
    return along(total, lamp_colour(lamps, 0), tears * glint * shadow * f4(1.3) + flesh * moist * shade)


@fast_device
def _window(back: Vec, direction: Vec, size: float) -> float:
    """Return 1 where the mirrored ray meets a softbox of half-width `size` (tangent), with round corners."""
    ahead = dot(back, direction)
    if ahead <= f4(0.1):
        return f4(0)
    side = unit(cross((f4(0), f4(1), f4(0)), direction))
    across, up = (
        dot(back, side) / (ahead * size),
        dot(back, cross(direction, side)) / (ahead * size * f4(1.25)),
    )
    across, up = across * across, up * up
    return f4(1) - smooth(f4(0.55), f4(1.35), across * across + up * up)
