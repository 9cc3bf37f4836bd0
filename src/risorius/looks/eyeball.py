"""The eyes' geometry and iris."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array, ByteArray, Float32Array, Int32Array
from ..core.look import ByteColour
from ..machine.kernels.jit import f4
from .noise import noise_at
from .srgb import linear, srgb_decode, srgb_encode

IRIS = f4(0.365)  # radius of the iris in radii of the eye
AXIS = 4.0
"""Degrees by which the pupil's axis stands out from the line of sight (angle kappa).

People have 2.8 by the synoptophore and 5.6 by the Orbscan (Basmak and others 2007).
"""
_PUPIL = 0.36 * float(IRIS)  # of the eyeball's radius
_SCLERA = (228, 220, 212)
_RINGS, _SECTORS = 16, 40
_WIDEST = np.radians(80.0)
_IRIS_RINGS, _IRIS_ANGLES = 64, 720


def cap() -> tuple[Array, Int32Array]:
    """Return the front of the unit sphere: vertices (n, 3) around +z, triangles (m, 3) wound outwards."""
    polar = _WIDEST * np.arange(1, _RINGS + 1) / _RINGS
    around = 2 * np.pi * np.arange(_SECTORS) / _SECTORS
    ring = np.stack(
        [
            np.sin(polar)[:, None] * np.cos(around),
            np.sin(polar)[:, None] * np.sin(around),
            np.repeat(np.cos(polar)[:, None], _SECTORS, axis=1),
        ],
        axis=-1,
    )
    vertices = np.concatenate([[[0.0, 0.0, 1.0]], ring.reshape(-1, 3)])
    index = 1 + np.arange(_RINGS * _SECTORS).reshape(_RINGS, _SECTORS)
    following = np.roll(index, -1, axis=1)
    fan = np.stack([np.zeros(_SECTORS, int), index[0], following[0]], axis=1)
    first = np.stack([index[:-1], index[1:], following[1:]], axis=-1).reshape(-1, 3)
    second = np.stack([index[:-1], following[1:], following[:-1]], axis=-1).reshape(-1, 3)
    return vertices, np.concatenate([fan, first, second]).astype(np.int32)


def pupil_axes() -> Array:
    """Return the rotations (2, 3, 3) of the left and the right eye from the line of sight to the pupil."""
    angle = np.radians(AXIS) * np.array([1.0, -1.0])
    result = np.tile(np.eye(3), (2, 1, 1))
    result[:, 0, 0] = result[:, 2, 2] = np.cos(angle)
    result[:, 0, 2], result[:, 2, 0] = np.sin(angle), -np.sin(angle)
    return result


def iris_image(inner: ByteColour, outer: ByteColour) -> Float32Array:
    """Return the linear albedo (rings, angles, 3) of an iris, from the pupil outwards.

    `inner` and `outer` are its colours. It has radial fibres, a ruff around the pupil, a few furrows, and a
    dark limbus.
    """
    r = (np.arange(_IRIS_RINGS) / (_IRIS_RINGS - 1))[:, None]
    angle = (2 * np.pi * np.arange(_IRIS_ANGLES) / _IRIS_ANGLES)[None, :]
    fibres = 0.55 * _ring_noise(r, angle, 16.0, 0.9) + 0.55 * _ring_noise(r, angle, 40.0, 1.6)
    crypts = np.clip(_ring_noise(r, angle, 7.0, 3.5) - 0.7, 0.0, 1.2)
    edge = 0.30 + 0.05 * _ring_noise(r * 0, angle, 6.0, 0.0)
    ruff = np.exp(-(((r - edge) / 0.07) ** 2))
    share = np.clip(1.25 * (1 - r) ** 1.8 + 0.14 * fibres, 0.0, 1.0)[..., None]
    colour = share * srgb_decode(np.array(inner) / 255) + (1 - share) * srgb_decode(np.array(outer) / 255)
    light = 1.05 + 0.34 * fibres + 0.22 * ruff - 0.42 * crypts * np.clip(4.0 * (r - 0.25), 0.0, 1.0)
    light *= 1.0 - 0.88 * np.clip((r - 0.70) / 0.30, 0.0, 1.0) ** 1.4
    light *= 0.45 + 0.55 * np.clip(r / 0.12, 0.0, 1.0)
    return np.asarray(colour * np.clip(light, 0.08, 2.2)[..., None], np.float32)


def iris_picture(inner: ByteColour, outer: ByteColour, side: int = 256) -> ByteArray:
    """Return the front of an eye seen straight on, sRGB (side, side, 3), as wide as the eyeball.

    `inner` and `outer` are the iris' sRGB colours at the pupil and at the rim.
    """
    image, rim = iris_image(inner, outer), float(IRIS)
    x = (np.arange(side) + 0.5) / side * 2.0 - 1.0
    across, down = np.meshgrid(x, x)
    radius, angle = np.hypot(across, down), np.arctan2(-down, across) % (2.0 * np.pi)
    way = (radius - _PUPIL) / (rim - _PUPIL)
    rows = np.clip(way * (len(image) - 1), 0, len(image) - 1).round().astype(int)
    columns = (angle / (2.0 * np.pi) * image.shape[1]).astype(int) % image.shape[1]
    picture = image[rows, columns].astype(np.float64)
    picture[way < 0.0] = 0.005
    edge = np.clip((way - 1.0) / 0.06, 0.0, 1.0)[..., None]
    picture = picture + edge * (linear(_SCLERA) - picture)
    return np.asarray(np.round(255.0 * srgb_encode(np.clip(picture, 0.0, 1.0))), np.uint8)


def _ring_noise(r: Array, angle: Array, across: float, along: float) -> Array:
    """Return noise (rings, angles) with `across` waves around the ring and `along` from pupil to limbus."""
    r, angle = np.broadcast_arrays(r, angle)
    points = np.stack([np.cos(angle) * across, np.sin(angle) * across, r * along * 2 * np.pi], axis=-1)
    return noise_at(points.reshape(-1, 3), 2 * np.pi).reshape(r.shape)
