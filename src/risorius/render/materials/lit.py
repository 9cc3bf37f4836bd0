"""The light that arrives at a point: the ambient light, and the key lamp's shadow with a warm edge."""

from __future__ import annotations

from ...core.arrays import Float32Array
from ...machine.kernels.jit import device, f4
from ...machine.kernels.vec import Vec, mix
from ..inputs import SceneLight
from ..shading_block import LAMPS, LANES, REACH
from ..shadow import lit

AmbientLight = tuple[Vec, Vec]


@device("fast")
def ambient_of(ambient: Float32Array) -> AmbientLight:
    """Return the ambient light from below and from above."""
    return (ambient[1, 0], ambient[1, 1], ambient[1, 2]), (ambient[0, 0], ambient[0, 1], ambient[0, 2])


@device("fast")
def ambient_on(ambient: AmbientLight, normal: Vec, free: float) -> Vec:
    """Return the ambient light on a surface that sees the share `free` of it; creases glow warm."""
    r, g, b = mix(ambient[0], ambient[1], normal[1] * f4(0.5) + f4(0.5))
    warm = free * (f4(1) - free)
    return r * (free + f4(0.35) * warm), g * (free + f4(0.08) * warm), b * free


@device("fast")
def ambient_light(ambient: Float32Array, normal: Vec, free: float) -> Vec:
    """Return `ambient_on` of the rows (2, 3) from above and from below."""
    return ambient_on(ambient_of(ambient), normal, free)


@device("fast", inlined=True)
def key_share(light: SceneLight, p: Vec) -> float:
    """Return the share of the key lamp that reaches p."""
    return lit(light.shadow, light.shadow_low, light.shadow_high, light.shadow_matrix, p, light.bias)


@device("fast")
def lamp_direction(lamps: Float32Array, k: int) -> Vec:
    """Return the unit vector towards lamp k."""
    return lamps[k, 0], lamps[k, 1], lamps[k, 2]


@device("fast")
def lamp_colour(lamps: Float32Array, k: int) -> Vec:
    """Return the colour of lamp k."""
    return lamps[k, 3], lamps[k, 4], lamps[k, 5]


@device("fast")
def lamp_share(reach: Float32Array, corners: tuple[int, int, int], weights: Vec, k: int) -> float:
    """Return the share of lamp k that arrives at a place in a triangle, interpolated between its corners."""
    a, b, c = corners
    share: float = weights[0] * reach[a, k] + weights[1] * reach[b, k] + weights[2] * reach[c, k]
    return share


@device("fast")
def read_reach(
    block: Float32Array, lane: int, reach: Float32Array, corners: tuple[int, int, int], weights: Vec
) -> None:
    """Write the shares of all lamps that arrive at a place in a triangle, see `lamp_share`, into a lane."""
    for lamp in range(LAMPS):
        block[REACH + lamp * LANES + lane] = lamp_share(reach, corners, weights, lamp)


@device("fast")
def warm_edge(share: float) -> Vec:
    """Return a shadow's share by channel: red bleeds furthest into it."""
    edge = share * (f4(1) - share)
    return share + f4(0.35) * edge, share + f4(0.1) * edge, share
