"""Short hair, combed back from the face, in locks, with a soft hairline."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..core.arrays import Array
from ..face.head.identity import Looks
from .anatomy import Anatomy, smoothstep
from .locks import gather_locks, height_over_skin, smoothed
from .scalp import LAYERS, HairRoots, flow, grow_layers, inside_hairline, layer_heights, styled_density
from .strands import Strands
from .surface import Surface, flat

POINTS = 6
_SEED = 21


def grow_short(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> Strands:
    """Return `looks.hairs` hairs of linear albedo `colour` (3,)."""
    rng = np.random.default_rng(_SEED)
    density = styled_density(anatomy, surface.points, "short")
    behind = smoothstep(-115.0, -150.0, surface.points[:, 2])
    front = 1.0 - smoothstep(4.0, 26.0, inside_hairline(anatomy, surface.points))
    density = density * (1.0 - 0.5 * behind) * (1.0 + 1.2 * front)
    triangles, weights = grow_layers(anatomy, surface, density, looks.hairs // LAYERS, _SEED)
    count = len(triangles)
    origin, normal = surface.at(triangles, weights)
    within = inside_hairline(anatomy, origin)
    length = _lengths(anatomy, origin, within) * (0.75 + 0.5 * rng.random(count))
    layer = layer_heights(count, rng) ** 0.7
    curves = _walk(anatomy, surface, HairRoots(origin, normal, length, layer), rng)
    curves, lock = gather_locks(smoothed(curves), length, smoothstep(0.0, 18.0, within), rng)
    shade = (0.72 + 0.4 * rng.random(count)) * lock * (1.9 - 0.9 * smoothstep(0.0, 12.0, within))
    way = np.linspace(0.0, 1.0, POINTS)
    fine = 0.36 + 0.64 * smoothstep(0.0, 14.0, within)
    widths = 0.52 * fine[:, None] * (1 - 0.75 * way**2)
    depths = 0.55 * (1 - layer) * smoothstep(2.0, 14.0, within)
    return surface.root(triangles, weights, curves, widths, shade[:, None] * colour, depths, 1.0)


def _lengths(anatomy: Anatomy, origin: Array, within: Array) -> Array:
    """Return lengths (S,) in mm: long on top, short at sides and neck, shorter still at the hairline."""
    u = anatomy.unit
    high = smoothstep(38.0 * u, 84.0 * u, origin[:, 1] - anatomy.eye_height)
    edge = 0.5 + 0.5 * smoothstep(0.0, 12.0 * u, within)
    behind = smoothstep(-80.0 * u, -140.0 * u, origin[:, 2])
    return np.asarray((9.0 + 43.0 * high * (1.0 - 0.45 * behind)) * edge * u)


def _walk(anatomy: Anatomy, surface: Surface, roots: HairRoots, rng: np.random.Generator) -> Array:
    """Return curves (S, POINTS, 3) that leave the skin, bend over, and follow it at their layer's height."""
    origin, normal, length, layer = roots
    u = anatomy.unit
    tree = cKDTree(surface.points)
    high = smoothstep(38.0 * u, 84.0 * u, origin[:, 1] - anatomy.eye_height)
    # Hair stands highest over the forehead, and lies flat at the back.
    behind = smoothstep(-60.0 * u, -130.0 * u, origin[:, 2])
    inside = smoothstep(-4.0 * u, 16.0 * u, inside_hairline(anatomy, origin))
    volume = (1.2 + (17.0 - 9.0 * behind) * high * inside) * u
    height = volume * (0.25 + 0.75 * layer)
    stray = rng.normal(0.0, 0.10, origin.shape)
    curves, ahead = [origin], flow(anatomy, origin, normal)
    for k in range(1, POINTS):
        way = k / (POINTS - 1)
        place = curves[-1] + flat(ahead + stray, normal) * (length / (POINTS - 1))[:, None]
        above, normal = height_over_skin(tree, surface, place)
        lift = height * np.sin(np.pi / 2 * min(1.0, 1.6 * way)) * (1 - 0.5 * way**2) + 0.3
        curves.append(place + (lift - above)[:, None] * normal)
        ahead = flow(anatomy, curves[-1], normal)
    return np.stack(curves, axis=1)
