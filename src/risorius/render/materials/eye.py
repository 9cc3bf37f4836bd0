"""The eye: a wet sphere with an iris behind a clear cornea, in the shade of its lids."""

from __future__ import annotations

import math

from ...core.arrays import Float32Array
from ...looks.attributes import EYE_LEFT
from ...looks.eyeball import IRIS
from ...machine.kernels.jit import device, f4
from ...machine.kernels.vec import (
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
from ..brdf import gloss, schlick
from ..grain import grain
from ..inputs import Batch, Pose, PosedMesh, SceneLight, Screen, Tables
from .lit import ambient_light, key_share, lamp_colour, lamp_direction
from .shading_sample import corners_of, put, towards, weights_of

LID_STEPS = 32
_FRONT = 2  # lamps; the others stand behind the head
_LIMBUS = f4(0.045)  # half the width of its soft edge
CORNEA = f4(0.46)
"""Centre of the cornea's sphere on the axis, in radii of the eye."""
_DEPTH = f4(0.075)  # of the iris behind the limbus, in radii of the eye
_REFRACTION = f4(1 / 1.336)
_WHITE = (f4(0.62), f4(0.57), f4(0.53))
_PINK = (f4(0.56), f4(0.25), f4(0.21))
_FLESH = (f4(0.50), f4(0.185), f4(0.155))  # the caruncle, in the inner corner
VEINS = (f4(0.45 * 2.6), f4(2.6), f4(2.6))
"""Cells of the grain per mm along x, y and z of the eye: veins run across."""
WHITE_AROUND, IRIS_AROUND = f4(0.95), f4(1.1)
"""Share of the ambient light that white and iris scatter."""
WET = f4(0.03)
"""Share that the tear film mirrors at a right angle."""
KEY_WINDOW, FILL_WINDOW = f4(0.23), f4(0.26)
"""Half the width (tangent) of the softboxes that are mirrored, of the first lamp and of the second."""
KEY_BRIGHT, FILL_BRIGHT = f4(1.9), f4(0.25)
"""Their brightness, as a share of the lamps' light."""


@device("fast")
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


@device("fast", inlined=True)
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
    iris = iris_share(local)
    shadow = key_share(light, p) * shade
    total = (f4(0), f4(0), f4(0))
    if iris < f4(1):
        total = _sclera(light, tables, local, outward, radius, above, inner, outer, shade, shadow)
    facing = outward
    if iris > f4(0):
        bulge = unit((local[0], local[1], local[2] - CORNEA))
        facing = rotate(pose.eye_axes[side], bulge)
        facing = unit(mix(outward, facing, iris))
        total = mix(total, _iris(light, pose, tables, side, local, facing, view, shade, shadow), iris)
    return add(
        total, _wet(light.lamps, light.ambient, facing, outward, view, shade, shadow, below, above, inner)
    )


@device("fast")
def iris_share(local: Vec) -> float:
    """Return the share 0..1 of iris at a place of the eye's unit sphere in the eye's frame."""
    if local[2] <= f4(0):
        return f4(0)
    ring = math.sqrt(local[0] * local[0] + local[1] * local[1])
    return f4(1) - smooth(IRIS - _LIMBUS, IRIS + _LIMBUS, ring)


@device("fast")
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


@device("fast")
def _corner_distances(span: Float32Array, side: int, in_head: Vec, radius: float) -> tuple[float, float]:
    """Return mm across from the inner and from the outer corner of the lids."""
    x = in_head[0] * radius
    first, second = max(x - span[side, 0], f4(0)), max(span[side, 1] - x, f4(0))
    return (first, second) if side == 0 else (second, first)


@device("fast")
def lid_shade(below: float, above: float, inner: float, outer: float) -> float:
    """Return the share of light, 0..1, that lids, lashes and corners of the eye let through."""
    upper = f4(1) - f4(0.52) * math.exp(-below * f4(0.75)) - f4(0.30) * math.exp(-below * f4(0.22))
    lower = f4(1) - f4(0.38) * math.exp(-above * f4(0.9))
    corners = (f4(1) - f4(0.42) * math.exp(-inner * f4(0.34))) * (
        f4(1) - f4(0.5) * math.exp(-outer * f4(0.34))
    )
    return upper * lower * corners


@device("fast", inlined=True)
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
    vein = grain(tables.grain, times(scale(local, radius), VEINS), f4(1))[0]
    albedo = white_of_eye(vein, above, inner, outer)
    total = times(albedo, scale(ambient_light(light.ambient, normal, shade), WHITE_AROUND))
    for k in range(min(len(light.lamps), _FRONT)):
        wrapped = white_share(dot(normal, lamp_direction(light.lamps, k)))
        total = along(
            total, times(albedo, lamp_colour(light.lamps, k)), wrapped * (shadow if k == 0 else shade)
        )
    return total


@device("fast")
def white_of_eye(height: float, above: float, inner: float, outer: float) -> Vec:
    """Return the albedo of the white where the grain has this `height`; distances in mm as above."""
    near = math.exp(-inner * f4(0.14)) + f4(0.8) * math.exp(-outer * f4(0.16))
    vein = (f4(1) - smooth(f4(0), f4(0.16), abs(height))) * near
    red = f4(0.46) * math.exp(-inner * f4(0.30)) + f4(0.34) * math.exp(-outer * f4(0.3))
    red += f4(0.30) * math.exp(-above * f4(1.1)) + f4(0.42) * vein
    albedo = mix(_WHITE, _PINK, saturate(red))
    return mix(albedo, _FLESH, f4(1) - smooth(f4(0.7), f4(2.5), inner))


@device("fast")
def white_share(facing: float) -> float:
    """Return the share of a lamp's light that the white scatters; `facing` is the cosine to the lamp."""
    return saturate((facing + f4(0.4)) * f4(1 / 1.4))


@device("fast", inlined=True)
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
    x, y = on_iris(local, unrotate(pose.eye_axes[side], refracted(facing, view)))
    albedo = _iris_colour(tables.iris, light.pupil, x, y, math.sqrt(x * x + y * y))
    axis = (pose.eye_axes[side, 0, 2], pose.eye_axes[side, 1, 2], pose.eye_axes[side, 2, 2])
    total = times(albedo, scale(ambient_light(light.ambient, axis, shade), IRIS_AROUND))
    for k in range(min(len(light.lamps), _FRONT)):
        lamp = unrotate(pose.eye_axes[side], lamp_direction(light.lamps, k))
        arriving = shadow if k == 0 else shade
        total = along(total, times(albedo, lamp_colour(light.lamps, k)), gathered(x, y, lamp) * arriving)
    return total


@device("fast")
def refracted(facing: Vec, view: Vec) -> Vec:
    """Return the way of sight within the eye; `facing` is the cornea's normal, `view` leads to the viewer."""
    cosine = dot(facing, view)
    bent = math.sqrt(f4(1) - _REFRACTION * _REFRACTION * (f4(1) - cosine * cosine))
    return along(scale(view, -_REFRACTION), facing, _REFRACTION * cosine - bent)


@device("fast")
def on_iris(local: Vec, ray: Vec) -> tuple[float, float]:
    """Return where a ray from the eye's unit sphere meets the iris' plane, in radii of the iris."""
    plane = math.sqrt(f4(1) - IRIS * IRIS) - _DEPTH
    way = (plane - local[2]) / min(ray[2], f4(-0.1))
    return (local[0] + ray[0] * way) / IRIS, (local[1] + ray[1] * way) / IRIS


@device("fast")
def gathered(x: float, y: float, lamp: Vec) -> float:
    """Return the share of a lamp's light at a place of the iris; `lamp` leads to it in the eye's frame."""
    distance = math.sqrt(x * x + y * y)
    share = saturate(f4(0.62) - f4(0.75) * (x * lamp[0] + y * lamp[1]) * saturate(distance * f4(1.4)))
    return share * saturate(lamp[2] + f4(0.2)) * f4(1.35)


@device("fast")
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
    return scale(mix(low, high, s), pupil_edge(pupil, distance))


@device("fast")
def pupil_edge(pupil: float, distance: float) -> float:
    """Return 0 within the pupil, 1 on the iris; both numbers are in radii of the iris."""
    return smooth(pupil - f4(0.03), pupil + f4(0.045), distance)


@device("fast")
def _texel(image: Float32Array, i: int, j: int) -> Vec:
    return image[i, j, 0], image[i, j, 1], image[i, j, 2]


@device("fast")
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
    """Return the reflection in the tear film: lamps, ambient light, the lower lid's rim and the caruncle."""
    free = mirror_share(below, shade)
    total = scale(ambient_light(ambient, facing, f4(1)), schlick(dot(facing, view), WET) * free)
    back = along(scale(view, f4(-1)), facing, f4(2) * dot(facing, view))
    for k in range(min(len(lamps), _FRONT)):
        direction, colour = lamp_direction(lamps, k), lamp_colour(lamps, k)
        size = KEY_WINDOW if k == 0 else FILL_WINDOW
        bright = KEY_BRIGHT if k == 0 else FILL_BRIGHT
        total = along(total, colour, window(back, direction, size) * free * bright)
    key = lamp_direction(lamps, 0)
    rim, moist = tear_glint(outward, view, key, above), caruncle_glint(outward, view, key, inner)
    return along(total, lamp_colour(lamps, 0), rim * shadow + moist * shade)


@device("fast")
def mirror_share(below: float, shade: float) -> float:
    """Return the share that is mirrored: a mirror shows the lid above it rather than its shadow."""
    return smooth(f4(0.3), f4(1.6), below) * (f4(0.5) + f4(0.5) * shade)


@device("fast")
def tear_glint(outward: Vec, view: Vec, key: Vec, above: float) -> float:
    """Return the share of the key lamp that the tears on the lower lid's rim mirror."""
    line = unit(add(outward, (f4(0), f4(0.8), f4(0))))
    tears = smooth(f4(0), f4(0.22), above) * (f4(1) - smooth(f4(0.35), f4(0.8), above))
    return tears * (f4(0.045) + gloss(line, view, key, f4(0.16), f4(0.05))) * f4(1.3)


@device("fast")
def caruncle_glint(outward: Vec, view: Vec, key: Vec, inner: float) -> float:
    """Return the share of the key lamp that the moist flesh in the inner corner mirrors."""
    flesh = f4(1) - smooth(f4(1.2), f4(3.2), inner)
    return flesh * gloss(unit(add(outward, (f4(0), f4(0.2), f4(0)))), view, key, f4(0.10), f4(0.05))


@device("fast")
def window(back: Vec, direction: Vec, size: float) -> float:
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
