"""From linear light to the bytes of the picture."""

from __future__ import annotations

import math

import numpy as np

from ..core.arrays import Array, ByteArray, Float32Array, FloatArray
from ..looks.srgb import srgb_encode
from ..machine.kernels.jit import device, f4, index
from ..machine.kernels.vec import bounded

TONES = 4096
WHITE = 6.0  # scene light that becomes full white


def film(linear: FloatArray) -> Array:
    """Return display light 0..1 of scene light: a toe that deepens shadows, a soft shoulder up to WHITE."""
    x = np.clip(np.asarray(linear, np.float64), 0.0, WHITE)
    rolled = x * (1 + x / WHITE**2) / (1 + 0.55 * x) * ((1 + 0.55 * WHITE) / (WHITE + 1))
    return np.clip(1.30 * rolled**1.18 / (1 + 0.30 * rolled**1.18), 0.0, 1.0)


def film_table() -> Float32Array:
    """Return display light (TONES,) float32 for each square root of scene light from 0 to √WHITE."""
    return film(np.linspace(0.0, np.sqrt(WHITE), TONES) ** 2).astype(np.float32)


def tone_table() -> ByteArray:
    """Return the sRGB byte (TONES,) for each square root of display light from 0 to 1."""
    light = np.linspace(0.0, 1.0, TONES) ** 2
    return np.asarray(srgb_encode(light) * 255 + 0.5).astype(np.uint8)


def to_bytes(light: Float32Array) -> ByteArray:
    """Return the sRGB bytes of display light 0..1 as `to_byte` gives them."""
    place = np.sqrt(np.clip(light, np.float32(0), np.float32(1))) * np.float32(TONES - 1) + np.float32(0.5)
    return tone_table()[place.astype(np.uint32)]


@device("fast")
def exposed(table: Float32Array, light: float) -> float:
    """Look up the display light of scene light in `film_table`."""
    display: float = table[_place(light)]
    return display


@device("fast")
def _place(light: float) -> int:
    x = math.sqrt(bounded(light, f4(WHITE))) * f4((TONES - 1) / math.sqrt(WHITE))
    return index(x + f4(0.5))


@device("fast")
def developed(table: ByteArray, light: float) -> int:
    """Look up the byte for one channel of scene light in `to_bytes(film_table())`."""
    byte: int = table[_place(light)]
    return byte


@device("fast")
def to_byte(table: ByteArray, light: float) -> int:
    """Look up the byte for one channel of display light 0..1."""
    byte: int = table[index(byte_place(light))]
    return byte


@device("fast")
def byte_place(light: float) -> float:
    """Return the place of display light in `tone_table`, of which the whole part counts."""
    return math.sqrt(bounded(light, f4(1))) * f4(TONES - 1) + f4(0.5)
