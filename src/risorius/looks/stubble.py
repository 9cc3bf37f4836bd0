"""A shaved head: stubble of a few millimetres."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from ..face.head.identity import Looks
from .anatomy import Anatomy, smoothstep
from .scalp import flow, grow_roots, hair_density, inside_hairline
from .strands import Strands
from .surface import Surface, unit

POINTS = 3
_SEED = 33


def grow_stubble(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> Strands:
    """Return `looks.hairs` hairs of linear albedo `colour` (3,), finer and sparser towards the hairline."""
    rng, count = np.random.default_rng(_SEED), looks.hairs
    density = hair_density(anatomy, surface.points, anatomy.masks["ears"]) ** 1.4
    triangles, weights = grow_roots(anatomy, surface, density, count, _SEED)
    origin, normal = surface.at(triangles, weights)
    within = smoothstep(0.0, 16.0, inside_hairline(anatomy, origin))
    length = (1.3 + 1.6 * within) * (0.7 + 0.6 * rng.random(count)) * anatomy.unit
    ahead = unit(0.7 * flow(anatomy, origin, normal) + normal + rng.normal(0.0, 0.16, origin.shape))
    way = np.linspace(0.0, 1.0, POINTS)
    curves = origin[:, None] + way[None, :, None] * (length[:, None] * ahead)[:, None]
    widths = (0.11 + 0.11 * within)[:, None] * (1.0 - 0.55 * way)
    shade = (0.8 + 0.5 * rng.random(count))[:, None] * colour
    return surface.root(triangles, weights, curves, widths, shade, np.full(count, 0.2), 0.3)
