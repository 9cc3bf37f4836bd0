"""The fine hairs at the hairline: short, thin and light, they let the edge of the hair fade into the skin."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..core.arrays import Array
from .anatomy import Anatomy, smoothstep
from .locks import height_over_skin
from .scalp import Combed, grow_roots, inside_hairline
from .strands import Strands
from .surface import Surface, flat

POINTS = 4
_SEED = 57
_SHARE = 0.11
_WIDTH = 0.2  # mm at the root
_FAINT = 0.6  # share of the skin in the colour of the outermost


def grow_hairline(
    anatomy: Anatomy, surface: Surface, colour: Array, skin: Array, count: int, combed: Combed
) -> Strands:
    """Return hairs of linear albedo `colour` (3,), over that of `skin` (3,), that lie as `combed` says.

    `count` is how many hairs a short style has. Hairs are finer than a pixel towards the edge: they take
    more of the skin's colour there, or each would be a dash.
    """
    count = round(_SHARE * count)
    rng = np.random.default_rng(_SEED)
    u = anatomy.unit
    triangles, weights = grow_roots(anatomy, surface, _density(anatomy, surface), count, _SEED)
    origin, normal = surface.at(triangles, weights)
    within = smoothstep(-2.0, 12.0, inside_hairline(anatomy, origin))
    length = (4.0 + 20.0 * within) * (0.6 + 0.8 * rng.random(count)) * u
    stray = rng.normal(0.0, 0.13, origin.shape)
    rise = rng.random(count)
    tree = cKDTree(surface.points)
    curves = [origin]
    for k in range(1, POINTS):
        place = (
            curves[-1]
            + flat(combed(anatomy, curves[-1], normal) + stray, normal) * (length / (POINTS - 1))[:, None]
        )
        above, normal = height_over_skin(tree, surface, place)
        height = 0.25 + (0.8 + 2.6 * within) * (k / (POINTS - 1)) * rise
        curves.append(place + (height - above)[:, None] * normal)
    way = np.linspace(0.0, 1.0, POINTS)
    widths = _WIDTH * (0.5 + 0.5 * within)[:, None] * (1.0 - 0.8 * way**1.5)
    shade = ((0.8 + 0.4 * rng.random(count)) * (1.7 - 0.7 * within))[:, None] * colour
    shade += (_FAINT * (1.0 - within) ** 2)[:, None] * (skin - shade)
    return surface.root(
        triangles,
        weights,
        np.stack(curves, axis=1),
        widths,
        shade,
        np.full(count, 0.1),
        0.6,
    )


def _density(anatomy: Anatomy, surface: Surface) -> Array:
    """Return the density (n,) of these hairs at the skin's vertices, a band before the ears."""
    within = inside_hairline(anatomy, surface.points)
    band = smoothstep(-1.5, 6.0, within) ** 1.5 * (1.0 - smoothstep(6.0, 13.0, within))
    front = smoothstep(-60.0 * anatomy.unit, -30.0 * anatomy.unit, surface.points[:, 2])
    # At the corners over the temples hair lies along the edge, where single hairs would look like dashes.
    u, height = anatomy.unit, surface.points[:, 1] - anatomy.eye_height
    corner = smoothstep(18.0 * u, 36.0 * u, np.abs(surface.points[:, 0])) * smoothstep(
        38.0 * u, 50.0 * u, height
    )
    return band * front * (1.0 - smoothstep(0.05, 0.3, anatomy.masks["ears"])) * (1.0 - 0.7 * corner)
