"""Eyebrows: fine hairs that rise at the nose, then sweep outwards and lie down towards the tail."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..core.arrays import Array
from .anatomy import Anatomy, smoothstep
from .strands import Strands, join
from .surface import Surface, flat

POINTS = 5
HEAD, TAIL = 10.0, 49.5  # mm from the middle
HEIGHT = 18.2  # mm of the head over the eyes
_SEED = 7
_LIGHT = 0.3  # mean albedo of hairs that do not glint


def brow_line(anatomy: Anatomy, t: Array) -> tuple[Array, Array, Array]:
    """Return |x|, height and half thickness of the brow in mm, from its head (t = 0) to its tail (t = 1)."""
    u = anatomy.unit
    x = (HEAD + (TAIL - HEAD) * t) * u
    rise = 5.6 * np.sin(np.clip(t / 0.68, 0.0, 1.0) * np.pi / 2) - 7.5 * np.clip(t - 0.68, 0.0, 1.0) ** 1.1
    thickness = (3.7 * (1 - t**1.7) + 0.6) * np.minimum(1.0, 0.62 + 2.2 * t)
    return x, anatomy.eye_height + (HEIGHT + rise) * u, thickness * u


def brow_shade(anatomy: Anatomy) -> Array:
    """Return by how much, 0 to 1, each skin vertex (N1,) is darkened under the brows."""
    x, y = np.abs(anatomy.skin[:, 0]), anatomy.skin[:, 1]
    t = (x / anatomy.unit - HEAD) / (TAIL - HEAD)
    _, centre, half = brow_line(anatomy, np.clip(t, 0.0, 1.0))
    across = np.exp(-(((y - centre) / (half + 0.6)) ** 4))
    ends = smoothstep(-0.08, 0.2, t) * (1 - smoothstep(0.85, 1.05, t))
    return across * ends * (anatomy.skin[:, 2] > 0)


def grow_brows(anatomy: Anatomy, surface: Surface, colour: Array, skin: Array, count: int = 360) -> Strands:
    """Return `count` hairs of linear albedo `colour` (3,) on each side, mirrored, over that of `skin` (3,).

    Hairs at the head, at the tail and along the edges are fine: they take more of the skin's colour, so that
    a brow has no outline.
    """
    rng = np.random.default_rng(_SEED)
    t = rng.beta(1.25, 1.15, count)
    x, centre, half = brow_line(anatomy, t)
    offset = np.clip(rng.normal(0.0, 0.5, count), -1.05, 1.05)
    # Hairs of the upper edge point down, those of the lower edge up: they meet along the brow's ridge.
    angle = (
        50 * (1 - t) ** 2.2 + 12 - 34 * t - 24 * offset * smoothstep(0.05, 0.4, t) + rng.normal(0, 4, count)
    )
    length = (
        (7.0 + 2.6 * rng.random(count))
        * (1 - 0.30 * t)
        * (0.5 + 0.5 * smoothstep(0.0, 0.3, t))
        * anatomy.unit
    )
    # Dark hairs glint; light ones that did so would stand out as dots.
    glint = 1.0 - min(1.0, float(colour.mean()) / _LIGHT)
    shade = (1.0 + glint * (0.2 + 0.9 * rng.random(count)))[:, None] * colour
    faint = 0.06 + 0.36 * np.abs(offset) ** 1.5 + 0.40 * (1.0 - smoothstep(0.0, 0.28, t))
    faint += 0.35 * smoothstep(0.72, 1.0, t)
    shade += np.clip(faint, 0.0, 0.8)[:, None] * (skin - shade)
    bend = rng.normal(-14, 8, count)
    sides = []
    for side in (1.0, -1.0):
        place = np.stack([side * x, centre + offset * half], axis=1)
        sides.append(_side(surface, place, side, np.radians(angle), np.radians(bend), length, shade))
    return join(sides)


def _side(
    surface: Surface, place: Array, side: float, angle: Array, bend: Array, length: Array, colour: Array
) -> Strands:
    triangles, weights = surface.nearest(_on_face(surface, place))
    origin, normal = surface.at(triangles, weights)
    curve = [origin + 0.1 * normal]
    for k in range(1, POINTS):
        way = k / (POINTS - 1)
        turned = angle + bend * way
        ahead = np.stack([side * np.cos(turned), np.sin(turned), np.zeros(len(turned))], axis=1)
        step = flat(ahead, normal) * (length / (POINTS - 1))[:, None]
        lift = 0.42 * (1 - 1.35 * way)
        curve.append(curve[-1] + step + lift * normal * 0.6)
    ways = np.linspace(0.0, 1.0, POINTS)
    widths = np.tile(0.12 * (1 - 0.85 * ways**1.6) * np.minimum(1.0, 0.75 + ways), (len(place), 1))
    return surface.root(
        triangles, weights, np.stack(curve, axis=1), widths, colour, np.full(len(place), 0.15), 0.25
    )


def _on_face(surface: Surface, place: Array) -> Array:
    """Return the points (S, 3) of the face's front at places (S, 2) in x and y."""
    front = np.flatnonzero((surface.normals[:, 2] > 0.1) & (surface.points[:, 2] > -20.0))
    _, nearest = cKDTree(surface.points[front, :2]).query(place, k=3)
    depth = surface.points[front[nearest], 2].mean(axis=1)
    return np.concatenate([place, depth[:, None]], axis=1)
