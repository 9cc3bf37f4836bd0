"""Tools for all styles of hair: height over the skin, smoothing, spacing of points, and locks."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..core.arrays import Array
from .anatomy import smoothstep
from .noise import noise_at
from .scalp import AXIS
from .surface import Surface, unit

_NEAREST = 12
_SWING, _WAVELENGTH = 10.0, 96.0  # mm: of the waviest hair
_AROUND = 80.0  # mm: radius of a circle around the skull's axis, along which the waves' phase changes
_EVEN = 0.7  # weight of even spacing against spacing by bends


def height_over_skin(tree: cKDTree, surface: Surface, places: Array) -> tuple[Array, Array]:
    """Return the height (S,) in mm of places (S, 3) over the skin, and the skin's normals (S, 3) there.

    Both are means over the nearest vertices, of which the last counts nothing: hairs would break where
    another one becomes the nearest.
    """
    distance, nearest = tree.query(places, k=_NEAREST)
    weight = (1.0 - distance / (distance[:, -1:] + 1e-9)) + 1e-6
    weight /= weight.sum(axis=1, keepdims=True)
    normal = unit(np.einsum("sk,skc->sc", weight, surface.normals[nearest]))
    foot = np.einsum("sk,skc->sc", weight, surface.points[nearest])
    return np.einsum("sc,sc->s", places - foot, normal), normal


def smoothed(curves: Array, rounds: int = 2) -> Array:
    """Return curves (S, P, 3) with inner points moved towards the middle of their neighbours."""
    curves = curves.copy()
    for _ in range(rounds):
        curves[:, 1:-1] = 0.25 * curves[:, :-2] + 0.5 * curves[:, 1:-1] + 0.25 * curves[:, 2:]
    return curves


def respaced(curves: Array, points: int) -> tuple[Array, Array]:
    """Return curves (S, P, 3) resampled at `points` places, dense where they bend, and these places.

    The places (S, points) are shares of a curve's length, 0 at the root to 1 at the tip.
    """
    steps = np.diff(curves, axis=1)
    lengths = np.linalg.norm(steps, axis=2) + 1e-9
    bends = _bends(steps / lengths[..., None])
    even = lengths / lengths.sum(axis=1, keepdims=True)
    shares = _summed(_EVEN * even + bends / (bends.sum(axis=1, keepdims=True) + 1.0))
    way = _summed(lengths)[..., None]
    return _at_shares(curves, shares, points), _at_shares(way, shares, points)[..., 0]


def _bends(ways: Array) -> Array:
    """Return the turn (S, P) in radians over each unit direction (S, P, 3): half of the turn at each end."""
    cosines = np.einsum("spc,spc->sp", ways[:, :-1], ways[:, 1:])
    turns = np.pad(np.arccos(np.clip(cosines, -1.0, 1.0)), ((0, 0), (1, 1)))
    return np.asarray(0.5 * (turns[:, :-1] + turns[:, 1:]))


def _summed(parts: Array) -> Array:
    """Return the running sum (S, P + 1) of the amounts (S, P) of parts, as shares of the total."""
    before = np.pad(np.cumsum(parts, axis=1), ((0, 0), (1, 0)))
    return np.asarray(before / before[:, -1:])


def _at_shares(values: Array, shares: Array, points: int) -> Array:
    """Return values (S, P, c), known at `shares` (S, P) from 0 to 1, interpolated at `points` even steps."""
    strands, samples = shares.shape
    even_shares = np.linspace(0.0, 1.0, points)
    upper = (shares[:, None, :] < even_shares[None, :, None]).sum(axis=2).clip(1, samples - 1)
    row = np.arange(strands)[:, None]
    low, high = shares[row, upper - 1], shares[row, upper]
    part = ((even_shares - low) / np.maximum(high - low, 1e-12))[..., None]
    return np.asarray(values[row, upper - 1] * (1.0 - part) + values[row, upper] * part)


def gather_locks(
    curves: Array,
    length: Array,
    amount: Array,
    rng: np.random.Generator,
    locks: int = 700,
    late: float = 1.3,
) -> tuple[Array, Array]:
    """Return hairs moved by `amount` (S,) towards the guide of one of `locks`, and each hair's shade (S,).

    Tips move more than roots: as the power `late` of the way along the hair. The shade is a factor on the
    colour, one for each lock.
    """
    count, points = curves.shape[:2]
    guides = rng.permutation(count)[: min(locks, count)]
    middle = curves[:, points // 2]
    _, mine = cKDTree(middle[guides]).query(middle)
    way = np.linspace(0.0, 1.0, points)[None, :, None]
    offset = curves - curves[:, :1]
    gathered = (
        offset[guides][mine] * (length / length[guides][mine])[:, None, None] + curves[guides][mine][:, :1]
    )
    drawn = curves + 0.6 * amount[:, None, None] * way**late * (gathered - curves)
    return drawn, 0.82 + 0.36 * rng.random(len(guides))[mine]


def waved(curves: Array, wave: float, u: float) -> Array:
    """Return curves (S, P, 3) that swing to and fro by `wave`, 0..1, the more the further from the root.

    `u` is the scale of the face.
    """
    steps = np.linalg.norm(np.diff(curves, axis=1), axis=2)
    along = np.pad(np.cumsum(steps, axis=1), ((0, 0), (1, 0))) / u
    ahead = unit(np.gradient(curves, axis=1))
    outwards = unit((curves - [0.0, 0.0, AXIS * u]) * [1.0, 0.0, 1.0])
    # Hairs that hang beside one another swing together.
    phase = 1.3 * noise_at(_AROUND * outwards[:, -1], 55.0)[:, None]
    turn = (2.0 * np.pi * (along - along[:, -1:]) / _WAVELENGTH + phase)[..., None]
    swing = (_SWING * wave * u * smoothstep(60.0, 150.0, along))[..., None]
    return np.asarray(
        curves + swing * (np.sin(turn) * unit(np.cross(ahead, outwards)) + 0.6 * np.cos(turn) * outwards)
    )
