"""The light that arrives at a point: the room's, and the key lamp's shadow with a warm edge."""

from __future__ import annotations

from ...core.arrays import Float32Array
from ...core.kernels.jit import f4, fast_device, fast_inlined
from ...core.kernels.vec import Vec, mix
from ..inputs import Light
from ..lanes import LAMPS, LANES, REACH
from ..shadow import lit

Room = tuple[Vec, Vec]


@fast_device
def room_of(room: Float32Array) -> Room:
    """Return the room's light from below and from above."""
    return (room[1, 0], room[1, 1], room[1, 2]), (room[0, 0], room[0, 1], room[0, 2])


@fast_device
def glow(room: Room, normal: Vec, free: float) -> Vec:
    """Return the room's light on a surface that sees the share `free` of it; creases glow warm."""
    r, g, b = mix(room[0], room[1], normal[1] * f4(0.5) + f4(0.5))
    warm = free * (f4(1) - free)
    return r * (free + f4(0.35) * warm), g * (free + f4(0.08) * warm), b * free


@fast_device
def room_light(room: Float32Array, normal: Vec, free: float) -> Vec:
    """Return `glow` of the room (2, 3)."""
    return glow(room_of(room), normal, free)


@fast_inlined
def key_share(light: Light, p: Vec) -> float:
    """Return the share of the key lamp that reaches p."""
    return lit(light.shadow, light.shadow_low, light.shadow_high, light.shadow_matrix, p, light.bias)


@fast_device
def lamp_direction(lamps: Float32Array, k: int) -> Vec:
    """Return the unit vector towards lamp k."""
    return lamps[k, 0], lamps[k, 1], lamps[k, 2]


@fast_device
def lamp_colour(lamps: Float32Array, k: int) -> Vec:
    """Return the colour of lamp k."""
    return lamps[k, 3], lamps[k, 4], lamps[k, 5]


@fast_device
def lamp_share(reach: Float32Array, corners: tuple[int, int, int], weights: Vec, k: int) -> float:
    """Return how much of lamp k arrives at a place in a triangle, as far as its corners tell."""
    a, b, c = corners
    share: float = weights[0] * reach[a, k] + weights[1] * reach[b, k] + weights[2] * reach[c, k]
    return share


@fast_device
def read_reach(
    block: Float32Array, lane: int, reach: Float32Array, corners: tuple[int, int, int], weights: Vec
) -> None:
    """Read into a lane how much of each lamp arrives at a place in a triangle, as far as its corners tell."""
    for lamp in range(LAMPS):
        block[REACH + lamp * LANES + lane] = lamp_share(reach, corners, weights, lamp)


@fast_device
def warm_edge(share: float) -> Vec:
    """Return a shadow's share by channel: red bleeds furthest into it."""
    edge = share * (f4(1) - share)
    return share + f4(0.35) * edge, share + f4(0.1) * edge, share
