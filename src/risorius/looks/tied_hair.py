"""Long hair, parted at the side, combed back and tied in a bun at the back of the head."""

from __future__ import annotations

import dataclasses

import numpy as np
from scipy.spatial import cKDTree

from ..core.arrays import Array
from ..face.head.identity import Looks
from .anatomy import Anatomy, smoothstep
from .locks import height_over_skin, respaced, smoothed
from .parting import beside_parting, from_parting, parted, wander
from .scalp import LAYERS, HairRoots, grow_layers, inside_hairline, layer_heights, styled_density
from .strands import Strands, join
from .surface import Surface, flat, unit

POINTS = 10
_STEPS = 24  # steps of a hair's path, from which its points are chosen
_SEED = 71
_SHARE, _BUN = 0.30, 0.07  # long hairs are drawn wider and in smaller number: on the head, and of the bun
_KNOT = 22.0  # mm: height of the knot over the eyes
_RADIUS, _DEEP = 25.0, 0.8  # mm of the bun, and how deep it is for its radius


def grow_tied(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> Strands:
    """Return hairs of linear albedo `colour` (3,), fewer than `looks.hairs`: longer ones are drawn wider."""
    rng = np.random.default_rng(_SEED)
    front = 1.0 - smoothstep(4.0, 26.0, inside_hairline(anatomy, surface.points))
    density = styled_density(anatomy, surface.points, "tied")
    # At the hairline and the parting no other hairs lie over the roots: there must be more.
    density *= 1.0 + 1.6 * front + 2.0 * parted(anatomy, surface.points)
    each = round(_SHARE * looks.hairs) // LAYERS
    triangles, weights = grow_layers(anatomy, surface, density, each, _SEED)
    origin, normal = surface.at(triangles, weights)
    layer = layer_heights(len(origin), rng) ** 0.6
    knot = _knot(anatomy, surface)
    roots = HairRoots(origin, normal, np.linalg.norm(origin - knot[0], axis=1), layer)
    curves, way = respaced(smoothed(_comb(anatomy, surface, roots, knot[0], rng), 4), POINTS)
    within = inside_hairline(anatomy, origin)
    shade = (0.82 + 0.26 * rng.random(len(origin))) * (1.5 - 0.5 * smoothstep(0.0, 12.0, within))
    widths = 0.7 * (0.4 + 0.6 * smoothstep(0.0, 14.0, within))[:, None] * (1.0 - 0.5 * way**6)
    bare = parted(anatomy, origin)
    depths = 0.4 * (1.0 - layer) * smoothstep(2.0, 14.0, within) * (1.0 - bare)
    # Hairs of the nape turn with the head that holds their other ends, not with the neck.
    low = origin[:, 1] < anatomy.eye_height
    triangles[low], weights[low] = surface.nearest(curves[low, -1])
    head = surface.root(triangles, weights, curves, widths, shade[:, None] * colour, depths, 1.0, 0.75 * bare)
    # Hairs from the forehead are seen from behind, too.
    return dataclasses.replace(join([head, _bun(anatomy, surface, colour, looks, knot, rng)]), behind=-2.0)


def tied_back(anatomy: Anatomy, points: Array, normals: Array) -> Array:
    """Return unit directions (n, 3) of hair along the skin: away from the parting, and back to the knot."""
    u = anatomy.unit
    away, distance = from_parting(anatomy, points)
    high = smoothstep(30.0 * u, 70.0 * u, points[:, 1] - anatomy.eye_height)
    aside = 0.9 * high * np.exp(-distance / (30.0 * u)) * np.tanh(distance / (6.0 * u))
    back = unit(np.array([0.0, anatomy.eye_height + _KNOT * u, -165.0 * u]) - points)
    back[:, 0] += aside * away[:, 0]
    return flat(unit(back) + wander(points), normals)


def _knot(anatomy: Anatomy, surface: Surface) -> tuple[Array, Array]:
    """Return the place (3,) of the knot in the middle of the back of the head, and the skin's normal (3,)."""
    middle = np.abs(surface.points[:, 0]) < 12.0 * anatomy.unit
    level = np.abs(surface.points[:, 1] - anatomy.eye_height - _KNOT * anatomy.unit) < 8.0 * anatomy.unit
    behind = np.flatnonzero(middle & level & (surface.points[:, 2] < -100.0 * anatomy.unit))
    place, normal = surface.points[behind].mean(axis=0), unit(surface.normals[behind].mean(axis=0))
    return place * [0.0, 1.0, 1.0], unit(normal * [0.0, 1.0, 1.0])


def _comb(
    anatomy: Anatomy, surface: Surface, roots: HairRoots, knot: Array, rng: np.random.Generator
) -> Array:
    """Return curves (S, _STEPS + 1, 3) that follow the skull to the knot at their layer's height."""
    origin, normal, _, layer = roots
    u = anatomy.unit
    skull = anatomy.masks["ears"] < 0.05
    smooth = Surface(surface.points[skull], surface.normals[skull], surface.triangles)
    tree = cKDTree(smooth.points)
    stray = rng.normal(0.0, 0.03, origin.shape)
    curves = [origin]
    for k in range(1, _STEPS + 1):
        way = k / _STEPS
        far = np.linalg.norm(knot - curves[-1], axis=1)
        step = 1.12 * far / (_STEPS + 1 - k)
        ahead = unit(tied_back(anatomy, curves[-1], normal) + stray)
        place = curves[-1] + step[:, None] * ahead
        above, normal = height_over_skin(tree, smooth, place)
        high = smoothstep(30.0 * u, 80.0 * u, place[:, 1] - anatomy.eye_height)
        thick = (2.5 + 2.5 * layer + 6.0 * high) * u * beside_parting(anatomy, place)
        height = thick * np.sin(np.pi / 2 * min(1.0, 2.6 * way)) + 0.3
        curves.append(place + (height - above)[:, None] * normal)
    return np.stack(curves, axis=1)


def _bun(
    anatomy: Anatomy,
    surface: Surface,
    colour: Array,
    looks: Looks,
    knot: tuple[Array, Array],
    rng: np.random.Generator,
) -> Strands:
    """Return the hairs of the bun: they wind around it."""
    u, count = anatomy.unit, round(_BUN * looks.hairs)
    place, ahead = knot
    across = np.array([1.0, 0.0, 0.0])
    up = np.cross(ahead, across)
    start = 2.0 * np.pi * rng.random(count)
    height = 0.25 + 1.2 * rng.random(count) ** 0.8  # angle over the bun's rim
    turn = start[:, None] + np.linspace(0.0, 2.2, POINTS)
    rise = height[:, None] + 0.25 * np.sin(turn + 1.0)
    radius = _RADIUS * u * (0.9 + 0.1 * rng.random(count))[:, None]
    aside, out = radius * np.cos(rise), _DEEP * radius * np.sin(rise)
    curves = place + (aside * np.cos(turn))[..., None] * across + (aside * np.sin(turn))[..., None] * up
    curves = curves + (out + 4.0 * u)[..., None] * ahead
    triangles, weights = surface.nearest(np.tile(place, (count, 1)))
    shade = (0.78 + 0.4 * rng.random(count)) * (0.75 + 0.25 * np.sin(height))
    widths = np.tile(0.8 * (1.0 - 0.6 * np.linspace(-1.0, 1.0, POINTS) ** 6), (count, 1))
    none = np.zeros(count)
    return surface.root(triangles, weights, curves, widths, shade[:, None] * colour, none, 1.0)
