"""The light of a lamp on a block of skin: scattered below the surface, and gloss."""

from __future__ import annotations

from ...core.arrays import Float32Array
from ...machine.kernels.jit import device, f4
from ...machine.kernels.vec import Vec, add, along, dot, times
from ..brdf import mirrored, mirrored_change, schlick
from ..shading_block import (
    ALBEDO,
    ANGLE,
    BELOW,
    BUMPY,
    CURVATURE,
    GRAIN,
    LANES,
    NORMAL,
    OPENED,
    REACH,
    ROUGHNESS,
    SHADOW,
    SHARE,
    SHINE,
    SOFT,
    STRENGTH,
    TOTAL,
    VIEW,
    WAY,
    get,
    put,
)
from ..subsurface import angle_place, curvature_place, scattered, steepness
from .lit import ambient_of, ambient_on, lamp_colour, lamp_direction, warm_edge

_DARK = f4(0.004)  # lamps of which less arrives are skipped
FACING = f4(0.028)
"""Share that is reflected at a right angle: index of refraction 1.4."""
SHARP, BROAD = f4(0.7), f4(2.2)
"""Share of the key lamp's gloss that is sharp, and how many times as wide the rest is."""
PORES_SOFT = f4(0.5)
"""Share of the pores' slope that affects light scattered below the surface."""
FRONT, GRAZED = 2, f4(0.4)
"""The number of lamps in front; the share of the others, behind the head, that skin mirrors."""


@device("fast")
def lamp_light(
    count: int, lamp: int, block: Float32Array, lamps: Float32Array, diffuse: Float32Array
) -> None:
    """Add the light of one lamp."""
    if not _arrive(count, lamp, block):
        return
    direction, colour, softness = lamp_direction(lamps, lamp), lamp_colour(lamps, lamp), lamps[lamp, 6]
    for k in range(LANES):
        block[ANGLE + k] = angle_place(dot(get(block, SOFT, k), direction))
    _look_up(count, block, diffuse)
    _add_scattered(block, colour)
    if lamp == 0:
        _add_key_gloss(block, direction, colour, softness)
    else:
        _add_gloss(block, direction, colour, softness, GRAZED if lamp >= FRONT else f4(1))


@device("fast")
def _arrive(count: int, lamp: int, block: Float32Array) -> bool:
    """Compute how much of a lamp arrives at each patch; return whether any patch gets enough of it."""
    for k in range(LANES):
        share = block[REACH + lamp * LANES + k]
        if lamp == 0:
            share *= block[SHADOW + k]
        elif lamp >= FRONT:
            share *= share  # light leaks between vertices that see the lamp and vertices that do not
        block[SHARE + k] = share if share >= _DARK else f4(0)
    most = f4(0)
    for k in range(count):
        most = max(most, block[SHARE + k])
    return most > f4(0)


@device("fast")
def _look_up(count: int, block: Float32Array, diffuse: Float32Array) -> None:
    """Compute the light of a lamp that the skin scatters."""
    for k in range(count):
        if block[SHARE + k] > f4(0):
            place = curvature_place(block[CURVATURE + k])
            put(block, BELOW, k, scattered(diffuse, block[ANGLE + k], place))


@device("fast")
def _add_scattered(block: Float32Array, colour: Vec) -> None:
    for k in range(LANES):
        below = times(get(block, BELOW, k), warm_edge(block[SHARE + k]))
        lit = times(times(get(block, ALBEDO, k), colour), below)
        put(block, TOTAL, k, add(get(block, TOTAL, k), lit))


@device("fast")
def _add_gloss(block: Float32Array, direction: Vec, colour: Vec, softness: float, part: float) -> None:
    for k in range(LANES):
        glint = _mirrored(block, k, direction, block[ROUGHNESS + k] + softness)
        amount = part * glint * block[SHARE + k] * block[STRENGTH + k]
        put(block, SHINE, k, along(get(block, SHINE, k), colour, amount))


@device("fast")
def _add_key_gloss(block: Float32Array, direction: Vec, colour: Vec, softness: float) -> None:
    """Add the key lamp's gloss: a sharp one and, of the oil's uneven film, a broad one."""
    for k in range(LANES):
        wide = block[ROUGHNESS + k] + softness
        sharp = _mirrored(block, k, direction, wide)
        glint = SHARP * sharp + (f4(1) - SHARP) * _mirrored(block, k, direction, wide * BROAD)
        amount = glint * block[SHARE + k] * block[STRENGTH + k]
        put(block, SHINE, k, along(get(block, SHINE, k), colour, amount))


@device("fast")
def _mirrored(block: Float32Array, k: int, direction: Vec, wide: float) -> float:
    bumpy, half = get(block, BUMPY, k), add(get(block, VIEW, k), direction)
    return mirrored(dot(bumpy, direction), dot(bumpy, half), dot(half, half), wide, FACING)


@device("fast")
def lamp_change(
    count: int, lamp: int, block: Float32Array, lamps: Float32Array, diffuse: Float32Array
) -> None:
    """Add to WAY how the green light of a lamp changes with the normal, right after `lamp_light`."""
    if not _arrive(count, lamp, block):
        return
    direction, colour, softness = lamp_direction(lamps, lamp), lamp_colour(lamps, lamp), lamps[lamp, 6]
    for k in range(count):
        block[GRAIN + k] = steepness(diffuse, block[ANGLE + k], curvature_place(block[CURVATURE + k]))
    part = GRAZED if lamp >= FRONT else f4(1)
    for k in range(LANES):
        share = block[SHARE + k]
        below = PORES_SOFT * block[ALBEDO + LANES + k] * block[GRAIN + k] * warm_edge(share)[1] * colour[1]
        normal, half = get(block, NORMAL, k), add(get(block, VIEW, k), direction)
        facing_light, facing_half, apart = dot(normal, direction), dot(normal, half), dot(half, half)
        wide = block[ROUGHNESS + k] + softness
        sharp = mirrored_change(facing_light, facing_half, apart, wide, FACING)
        if lamp == 0:
            broad = mirrored_change(facing_light, facing_half, apart, wide * BROAD, FACING)
            sharp = (
                SHARP * sharp[0] + (f4(1) - SHARP) * broad[0],
                SHARP * sharp[1] + (f4(1) - SHARP) * broad[1],
            )
        amount = part * share * block[STRENGTH + k] * colour[1]
        change = along(get(block, WAY, k), direction, below + amount * sharp[0])
        put(block, WAY, k, along(change, half, amount * sharp[1]))


@device("fast")
def edge_light(block: Float32Array, ambient: Float32Array) -> None:
    """Add the ambient light that the skin reflects along its outline."""
    around = ambient_of(ambient)
    for k in range(LANES):
        soft = get(block, SOFT, k)
        edge = edge_share(dot(soft, get(block, VIEW, k)), soft[1]) * block[OPENED + k] * block[STRENGTH + k]
        put(block, SHINE, k, along(get(block, SHINE, k), ambient_on(around, soft, f4(1)), edge))


@device("fast")
def edge_share(facing: float, up: float) -> float:
    """Return the share of the ambient light that skin reflects whose normal has these parts.

    `facing` is that towards the viewer, `up` the upper one.
    """
    # A rough surface reflects less along its outline than a smooth one.
    edge = min(schlick(facing, FACING), f4(0.16))
    # Below it are neck and body, of which nothing is mirrored.
    above = f4(1) + min(up, f4(0))
    return edge * above * above * f4(0.8)
