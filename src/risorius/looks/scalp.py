"""The scalp: the hairline around the skull, the density of hair, and the directions in which it lies."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from ..core.arrays import Array, FloatArray, Int32Array
from .anatomy import Anatomy, smoothstep
from .noise import noise_at
from .surface import Surface, flat, unit

# Heights of the hairline over the eyes in mm, by the angle from the front around an axis through the skull.
_ANGLES = (0, 10, 20, 28, 35, 41, 47, 53, 59, 66, 71, 77, 81, 88, 97, 103, 109, 118, 132, 150, 180)
_HEIGHTS = (62, 62, 60.8, 57.6, 53, 48, 41, 33, 22, 8, -6, -14, 4, 8, 7, -6, -28, -40, -52, -62, -66)
AXIS = -72.0  # mm: z of that axis
# Heights over the eyes in mm, and the angle from the front within which no hair of chin length hangs there.
FACE = (
    (-45.0, -12.0, 10.0, 25.0, 36.0, 45.0, 52.0, 57.0, 59.0),
    (43.0, 46.0, 48.0, 46.5, 42.0, 34.0, 23.0, 9.0, 0.0),
)
LAYERS = 4
# How far, in mm, hair of each style stands out over the skin beside it.
_THICK = {"short": 16.0, "medium": 20.0, "tied": 10.0, "shaved": 0.0, "bald": 0.0}
# Share of the light that hair takes from what lies below it: some comes through between the hairs.
_BURIED = 0.75
# How much the scalp is darkened under each style of hair.
_UNDER = {"short": 0.9, "medium": 0.98, "tied": 0.98, "shaved": 0.92, "bald": 0.0}
# mm inside the hairline over which hair of each style begins, so that its edge has no hairs alone: scratches.
EDGES = {"short": (0.0, 6.0), "medium": (1.0, 8.0), "tied": (1.0, 8.0)}
# mm inside the even hairline over which that shade rises: slowly, as skin knows it at few points, and where
# hair hides it. Stubble hides nothing.
_SHADES = {
    "short": (1.0, 20.0),
    "medium": (3.0, 14.0),
    "tied": (2.0, 14.0),
    "shaved": (-2.5, 21.0),
    "bald": (0.0, 1.0),
}


def inside_hairline(anatomy: Anatomy, points: Array, uneven: float = 1.0) -> Array:
    """Return the distance (n,) in mm of points (n, 3) inside the hairline, negative outside.

    `uneven` is how much the line swings to and fro, 1 as hair grows.
    """
    u = anatomy.unit
    angle = np.degrees(np.arctan2(np.abs(points[:, 0]), points[:, 2] - AXIS * u))
    line = anatomy.eye_height + u * np.interp(angle, _ANGLES, _HEIGHTS)
    swing = 1.6 * noise_at(points, 16.0) + 0.8 * noise_at(points, 6.0) if uneven else 0.0
    return np.asarray(points[:, 1] - line + uneven * u * swing)


def hair_density(anatomy: Anatomy, points: Array, ears: Array, uneven: float = 1.0) -> Array:
    """Return the density (n,) of hair at points (n, 3), 0..1: it rises over 17 mm, and is 0 on the ears."""
    inside = inside_hairline(anatomy, points, uneven)
    return smoothstep(-2.5, 15.0, inside) * (1.0 - smoothstep(0.05, 0.3, ears))


def styled_density(anatomy: Anatomy, points: Array, style: str) -> Array:
    """Return the density (n,) of a style of hair at points (n, 3), one for each vertex of the skin."""
    density = hair_density(anatomy, points, anatomy.masks["ears"])
    if style in EDGES:
        density = density * smoothstep(*EDGES[style], inside_hairline(anatomy, points))
    return density


def scalp_shade(anatomy: Anatomy, style: str) -> Array:
    """Return by how much, 0..1, each skin vertex (N1,) is darkened by hairs too fine to be drawn."""
    return _UNDER[style] * _hidden(anatomy, style)


def hair_shade(anatomy: Anatomy, style: str, lamps: FloatArray, albedo: float) -> tuple[Array, Array]:
    """Return which shares of light hair of a mean `albedo` takes from each skin vertex.

    The first (N1, n) is that of each lamp in the directions `lamps` (n, 3), the second (N1,) that of the
    light from above. Both are 0 for shaved and bald heads.
    """
    skin, ears = anatomy.skin, anatomy.masks["ears"]
    thick = _THICK[style]
    if thick == 0.0:
        return np.zeros((len(skin), len(lamps))), np.zeros(len(skin))

    def ahead(way: FloatArray) -> Array:
        steps = np.linspace(0.0, 1.0, 5)[1:]
        seen = [(1.0 - 0.7 * s) * hair_density(anatomy, skin + s * thick * way, ears, 0.0) for s in steps]
        return np.asarray(np.max(seen, axis=0))

    behind = _behind_hair(anatomy) if style == "medium" else np.zeros(len(skin))
    # Light comes to the skin through the hair, the more the lighter this is.
    absorbed = 1.0 - albedo
    covered = np.maximum(_BURIED * absorbed * _hidden(anatomy, style), behind)
    cast = np.stack([0.85 * absorbed * ahead(lamp) for lamp in np.asarray(lamps, np.float64)], axis=1)
    around = np.maximum(0.5 * absorbed * ahead(np.array([0.0, 1.0, 0.0])), np.exp(-4.0 * albedo) * behind)
    return 1.0 - (1.0 - covered[:, None]) * (1.0 - cast), around


def _hidden(anatomy: Anatomy, style: str) -> Array:
    """Return how far, 0..1, a style of hair hides each skin vertex (N1,)."""
    rise = smoothstep(*_SHADES[style], inside_hairline(anatomy, anatomy.skin, uneven=0.0))
    return np.asarray(rise * (1.0 - smoothstep(0.05, 0.3, anatomy.masks["ears"])))


def hair_ends(anatomy: Anatomy) -> float:
    """Return the height in mm at which hair of chin length ends: a little above the chin."""
    return 0.55 * float(anatomy.mouth[1]) + 0.45 * anatomy.chin


def _behind_hair(anatomy: Anatomy) -> Array:
    """Return how far, 0..1, hair of chin length hangs before each skin vertex (N1,), as before the ears.

    Lit skin would shine between hairs as specks.
    """
    skin, u = anatomy.skin, anatomy.unit
    angle = np.degrees(np.arctan2(np.abs(skin[:, 0]), skin[:, 2] - AXIS * u))
    free = np.interp((skin[:, 1] - anatomy.eye_height) / u, *FACE)
    end = hair_ends(anatomy)
    height = smoothstep(end - 12.0 * u, end + 8.0 * u, skin[:, 1])
    height *= smoothstep(46.0 * u, 14.0 * u, skin[:, 1] - anatomy.eye_height)
    # On the scalp the roots themselves are seen between hairs.
    height *= 1.0 - 0.5 * _hidden(anatomy, "medium")
    return np.asarray(smoothstep(-2.5, 2.5, angle - free) * height)


Combed: TypeAlias = Callable[[Anatomy, Array, Array], Array]
"""A style's directions (n, 3) of hair along the skin, by points (n, 3) and the skin's normals (n, 3)."""


def flow(anatomy: Anatomy, points: Array, normals: Array) -> Array:
    """Return unit directions (n, 3) of combed hair along the skin: back from the face, down at the sides."""
    u = anatomy.unit
    side = np.sign(points[:, 0]) * smoothstep(0.0, 25.0 * u, np.abs(points[:, 0]))
    high = smoothstep(30.0 * u, 75.0 * u, points[:, 1] - anatomy.eye_height)
    back = smoothstep(-70.0 * u, -150.0 * u, points[:, 2])
    # The parting is off the middle; hair leans away from it on both sides.
    lean = np.tanh((points[:, 0] + 30.0 * u) / (18.0 * u))
    combed = np.stack(
        [0.85 * lean * high + 0.25 * side * (1 - high), -0.9 * (1 - high) - 0.6 * back, -0.85 + 0.35 * back],
        axis=1,
    )
    wave = np.stack([noise_at(points + shift, 45.0) for shift in (0.0, 91.0, 57.0)], axis=1)
    return flat(unit(combed) + 0.16 * wave, normals)


def grow_roots(
    anatomy: Anatomy, surface: Surface, density: Array, count: int, seed: int
) -> tuple[Int32Array, Array]:
    """Return triangles (count,) and weights (count, 3) in them, spread over the skin by area and density.

    `density` (N1,) is that of the skin's vertices.
    """
    rng = np.random.default_rng(seed)
    corners = surface.points[surface.triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    share = area * density[surface.triangles].mean(axis=1)
    steps = (np.arange(count) + rng.random(count)) / count
    summed = np.cumsum(share)
    triangles = np.searchsorted(summed / summed[-1], steps)
    a, b = np.sqrt(rng.random(count)), rng.random(count)
    return triangles.astype(np.int32), np.stack([1 - a, a * (1 - b), a * b], axis=1)


def grow_layers(
    anatomy: Anatomy, surface: Surface, density: Array, each: int, seed: int
) -> tuple[Int32Array, Array]:
    """Return the triangles (n,) and weights (n, 3) of LAYERS layers of hair with `each` roots.

    Upper layers come first: the hairs under them then fail the depth test at once.
    """
    layers = [grow_roots(anatomy, surface, density, each, seed + k) for k in range(LAYERS)]
    triangles, weights = zip(*layers, strict=True)
    return np.concatenate(triangles), np.concatenate(weights)


class HairRoots(NamedTuple):
    """The roots of hairs, and the length to which they grow.

    origin  (n, 3) mm
    normal  (n, 3) of the skin, unit length
    length  (n,) mm
    layer   (n,) 0 at the skin to 1 at the outside
    """

    origin: Array
    normal: Array
    length: Array
    layer: Array


def layer_heights(count: int, rng: np.random.Generator) -> Array:
    """Return where `count` hairs lie among their layers (n,), as the roots of `grow_layers` are in order."""
    return np.asarray(1.0 - (np.arange(count) * LAYERS // count + rng.random(count)) / LAYERS)
