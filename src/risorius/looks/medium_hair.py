"""Hair of chin length, parted at the side and combed off the face; it hangs over the ears."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from scipy.spatial import cKDTree

from ..core.arrays import Array
from ..face.head.identity import Looks
from .anatomy import Anatomy, smoothstep
from .locks import gather_locks, height_over_skin, respaced, smoothed, waved
from .noise import noise_at
from .parting import PARTING, beside_parting, combed, near_whorl, parted
from .scalp import (
    AXIS,
    FACE,
    LAYERS,
    HairRoots,
    grow_layers,
    hair_ends,
    inside_hairline,
    layer_heights,
    styled_density,
)
from .strands import Strands
from .surface import Surface, flat, unit

POINTS = 13
_STEPS = 28  # steps of a hair's path, from which its points are chosen
_SEED = 45
_SHARE = 0.34  # longer hairs are drawn wider and in smaller number
_SOFT = math.radians(3.0)  # how softly hair is held off the face
_FINE = math.radians(-4.5), math.radians(1.5)  # where hairs that lie over the face's edge are finer: wisps
_CROSSED = math.radians(0.8)  # how far a hair may lie over the face's edge
# How far hair on the cheeks turns inwards and forwards, and by which share it is flatter.
_INWARDS, _FORWARDS, _FLATTER = 0.45, 0.1, 0.7
_LOCKS = 400
_DRAWN, _LATE = 1.2, 2.0  # how much, and how late on their way, hairs are drawn to their lock


def grow_medium(anatomy: Anatomy, surface: Surface, colour: Array, looks: Looks) -> Strands:
    """Return hairs of linear albedo `colour` (3,), fewer than `looks.hairs`: longer ones are drawn wider."""
    rng = np.random.default_rng(_SEED)
    front = 1.0 - smoothstep(4.0, 26.0, inside_hairline(anatomy, surface.points))
    density = styled_density(anatomy, surface.points, "medium")
    # At the front, the parting and the whorl no other hairs lie over the roots: there must be more.
    spread = parted(anatomy, surface.points) + near_whorl(anatomy, surface.points)
    density *= 1.0 + 2.2 * front + 4.0 * spread
    each = round(_SHARE * looks.hairs) // LAYERS
    triangles, weights = grow_layers(anatomy, surface, density, each, _SEED)
    count = len(triangles)
    origin, normal = surface.at(triangles, weights)
    layer = layer_heights(count, rng) ** 0.45
    # Cut in layers: the outer hairs are shorter, and locks end at different heights.
    cut = 1.02 - 0.05 * layer + 0.012 * noise_at(origin, 22.0)
    length = _lengths(anatomy, origin) * cut * (0.95 + 0.05 * rng.random(count) ** 0.6)
    curves = smoothed(_hang(anatomy, surface, HairRoots(origin, normal, length, layer), rng), 8)
    within = inside_hairline(anatomy, origin)
    curves = waved(curves, looks.wave, anatomy.unit)
    curves, lock = gather_locks(curves, length, _DRAWN * smoothstep(0.0, 18.0, within), rng, _LOCKS, _LATE)
    in_place = _in_place(anatomy, curves)
    triangles, weights, curves = triangles[in_place], weights[in_place], curves[in_place]
    count, layer, lock, within = len(curves), layer[in_place], lock[in_place], within[in_place]
    curves, way = respaced(curves, POINTS)
    shade = (0.82 + 0.26 * rng.random(count)) * lock * (1.5 - 0.5 * smoothstep(0.0, 12.0, within))
    fine = 0.34 + 0.66 * smoothstep(0.0, 14.0, within)
    fine *= _beside_face(anatomy, curves)
    widths = 0.85 * fine[:, None] * (1.0 - 0.85 * way**6)
    depths = 0.45 * (1.0 - layer) * smoothstep(2.0, 14.0, within)
    bare = parted(anatomy, curves[:, 0])
    depths *= 1.0 - bare
    hairs = surface.root(
        triangles, weights, curves, widths, shade[:, None] * colour, depths, 1.0, 0.75 * bare
    )
    # Hair from the nape shows beside the neck.
    return dataclasses.replace(hairs, behind=-2.0)


def _in_place(anatomy: Anatomy, curves: Array) -> Array:
    """Return which of the hairs `curves` (S, P, 3) neither hang alone below the others nor on the forehead
    and the temples.

    There, between single hairs, skin would shine through as specks.
    """
    places = curves.reshape(-1, 3)
    angle, _, least = _around(anatomy, places)
    bare = angle < least - _CROSSED
    is_bare = bare.reshape(len(curves), -1).any(axis=1)
    hangs_alone = curves[..., 1].min(axis=1) < hair_ends(anatomy) - 34.0 * anatomy.unit
    return np.asarray(~(is_bare | hangs_alone))


def _beside_face(anatomy: Anatomy, curves: Array) -> Array:
    """Return by which factors (S,) hairs `curves` (S, P, 3) are finer that lie over the face's edge."""
    angle, _, least = _around(anatomy, curves.reshape(-1, 3))
    crossed = (angle - least).reshape(len(curves), -1).min(axis=1)
    return 0.5 + 0.5 * smoothstep(*_FINE, crossed)


def _lengths(anatomy: Anatomy, origin: Array) -> Array:
    """Return lengths in mm (S,) that let all hair end a little above the chin."""
    u = anatomy.unit
    end = hair_ends(anatomy) - 10.0 * u
    high = smoothstep(20.0 * u, 90.0 * u, origin[:, 1] - anatomy.eye_height)
    away = np.where(origin[:, 0] > PARTING * u, -1.0, 1.0)
    across = np.clip(72.0 * u + away * origin[:, 0], 0.0, None)
    return np.asarray(np.maximum(1.04 * (origin[:, 1] - end) + 0.62 * high * across, 24.0 * u))


def _hang(anatomy: Anatomy, surface: Surface, roots: HairRoots, rng: np.random.Generator) -> Array:
    """Return curves (S, _STEPS + 1, 3) that run over the skull from the parting and then hang."""
    origin, normal, length, layer = roots
    skull = anatomy.masks["ears"] < 0.05
    smooth = Surface(surface.points[skull], surface.normals[skull], surface.triangles)
    tree = cKDTree(smooth.points)
    stray = rng.normal(0.0, 0.03, origin.shape)
    u = anatomy.unit
    volume = (5.0 + 5.0 * layer) * u
    curves, step = [origin], (length / _STEPS)[:, None]
    for k in range(1, _STEPS + 1):
        way = k / _STEPS
        place = curves[-1] + step * unit(_ahead(anatomy, curves[-1], normal) + stray)
        above, normal = height_over_skin(tree, smooth, place)
        rise = np.sin(np.pi / 2 * min(1.0, 3.4 * way)) * (1.0 - _FLATTER * _on_the_cheeks(anatomy, place))
        thick = (volume + _lift(anatomy, place)) * beside_parting(anatomy, place)
        height = thick * rise + 0.3 + _over_ears(anatomy, place)
        lying = _lying(anatomy, place)
        # Hair never enters the head, and does not stand off it where it lies on the skull.
        shift = np.maximum(height - above, 0.0) + lying * np.minimum(height - above, 0.0)
        curves.append(_off_face(anatomy, place + shift[:, None] * normal))
    return np.stack(curves, axis=1)


def _lying(anatomy: Anatomy, place: Array) -> Array:
    """Return how far, 0..1, hair at places (S, 3) lies on the head: lower at the back than at the sides."""
    u = anatomy.unit
    lower = 45.0 * u * smoothstep(-105.0 * u, -150.0 * u, place[:, 2])
    return smoothstep(-10.0 * u, 30.0 * u, place[:, 1] - anatomy.eye_height + lower)


def _lift(anatomy: Anatomy, place: Array) -> Array:
    """Return by how many mm (S,) hair at places (S, 3) rises over the crown, more behind than in front."""
    u = anatomy.unit
    high = smoothstep(35.0 * u, 80.0 * u, place[:, 1] - anatomy.eye_height)
    behind = 0.2 + 0.8 * smoothstep(20.0 * u, -50.0 * u, place[:, 2])
    return np.asarray(9.0 * u * high * behind)


def _ahead(anatomy: Anatomy, place: Array, normal: Array) -> Array:
    """Return the unit directions (S, 3) in which hair continues from places (S, 3)."""
    ways = combed(anatomy, place) + _turned_in(anatomy, place) + _to_the_cheeks(anatomy, place)
    lying = _lying(anatomy, place)[:, None]
    return unit(lying * flat(ways, normal) + (1.0 - lying) * ways)


def _over_ears(anatomy: Anatomy, place: Array) -> Array:
    """Return by how many mm (S,) hair at places (S, 3) stands further off the skull, where the ears are."""
    u = anatomy.unit
    ears = anatomy.skin[anatomy.masks["ears"] > 0.5, 2].mean()
    beside = np.exp(-(((place[:, 2] - ears + 6.0 * u) / (24.0 * u)) ** 2))
    return np.asarray(9.0 * u * beside * smoothstep(26.0 * u, 2.0 * u, place[:, 1] - anatomy.eye_height))


def _on_the_cheeks(anatomy: Anatomy, place: Array) -> Array:
    """Return how far, 0..1, hair at places (S, 3) hangs before the ears, where it lies on the cheeks."""
    u = anatomy.unit
    before = smoothstep(-100.0 * u, -30.0 * u, place[:, 2])
    return before * smoothstep(60.0 * u, 20.0 * u, place[:, 1] - anatomy.eye_height)


def _to_the_cheeks(anatomy: Anatomy, place: Array) -> Array:
    """Return the change of directions (S, 3) of hair at places (S, 3) towards the cheeks.

    Beside hair that hung straight down before the ears, these would show as dark stripes beside the face.
    """
    ways = np.stack(
        [-_INWARDS * np.sign(place[:, 0]), np.zeros(len(place)), np.full(len(place), _FORWARDS)], axis=1
    )
    return np.asarray(_on_the_cheeks(anatomy, place)[:, None] * ways)


def _turned_in(anatomy: Anatomy, place: Array) -> Array:
    """Return the change of directions (S, 3) of hair at places (S, 3) towards the neck: ends turn in."""
    u = anatomy.unit
    low = smoothstep(float(anatomy.mouth[1]) + 16.0 * u, anatomy.chin + 4.0 * u, place[:, 1])
    inwards = np.stack([-place[:, 0], np.zeros(len(place)), AXIS * u - place[:, 2]], axis=1)
    return 1.1 * low[:, None] * unit(inwards)


def _off_face(anatomy: Anatomy, place: Array) -> Array:
    """Return places (S, 3) turned back around the skull's axis until they hang beside the face."""
    angle, reach, least = _around(anatomy, place)
    # With a sharp limit the hairs would gather at it, and leave a gap behind them.
    least -= 1.5 * _SOFT
    turned = least + _SOFT * np.logaddexp(0.0, (angle - least) / _SOFT)
    moved = place.copy()
    moved[:, 0] = np.where(place[:, 0] < 0.0, -1.0, 1.0) * reach * np.sin(turned)
    moved[:, 2] = AXIS * anatomy.unit + reach * np.cos(turned)
    return moved


def _around(anatomy: Anatomy, place: Array) -> tuple[Array, Array, Array]:
    """Return where places (S, 3) are around the skull's axis: their angles (S,) from the front in radians and
    distances (S,) in mm, and the angles (S,) at which the face ends at their heights.

    Above the temples the face ends at the hairline.
    """
    u = anatomy.unit
    depth = place[:, 2] - AXIS * u
    angle, reach = np.arctan2(np.abs(place[:, 0]), depth), np.hypot(place[:, 0], depth)
    return angle, reach, np.radians(np.interp((place[:, 1] - anatomy.eye_height) / u, *FACE))
