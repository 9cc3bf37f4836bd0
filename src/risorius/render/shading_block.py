"""Blocks of patches that are shaded side by side, which suits the processor's vector units.

A block is one array in which each quantity has LANES numbers in a row, one for each patch. The number of
patch k stands at `POSITION + k`, and x, y and z of a vector lie LANES apart. Because all loops run over the
same LANES, at constant distances within one array, the compiler can handle several patches in one
instruction. It cannot in a loop that looks something up in another array, so such loops do nothing else.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import Float32Array
from ..machine.kernels.jit import device
from ..machine.kernels.vec import Vec, sub, unit
from .grain import Heights

LANES = 64
LAMPS = 4
"""Greatest number of lamps, constant for the compiler."""
_THREE = 3 * LANES

# Vectors: first those read from the mesh, then those computed from them.
POSITION, NORMAL, REST, ALBEDO, VIEW, SOFT, BUMPY, WAY, BELOW, TOTAL, SHINE = range(0, 11 * _THREE, _THREE)
# Numbers; GRAIN is the first of eight, REACH the first of LAMPS.
FREE, ROUGHNESS, STRENGTH, CURVATURE, INNER, CLOTH, OPENED, SHADOW, SHARE, ANGLE, GRAIN = range(
    11 * _THREE, 11 * _THREE + 11 * LANES, LANES
)
REACH = GRAIN + 8 * LANES
_SIZE = REACH + LAMPS * LANES


def empty_block() -> Float32Array:
    """Return one block full of ones, because lanes without a patch are computed, too."""
    return np.ones(_SIZE, np.float32)


@device("fast")
def get(block: Float32Array, first: int, k: int) -> Vec:
    """Return the vector of patch k."""
    return block[first + k], block[first + LANES + k], block[first + 2 * LANES + k]


@device("fast")
def put(block: Float32Array, first: int, k: int, vector: Vec) -> None:
    """Set the vector of patch k."""
    block[first + k], block[first + LANES + k], block[first + 2 * LANES + k] = vector


@device("fast")
def heights_in(block: Float32Array, k: int) -> Heights:
    """Return the eight heights of the grain about patch k."""
    return (
        block[GRAIN + k],
        block[GRAIN + LANES + k],
        block[GRAIN + 2 * LANES + k],
        block[GRAIN + 3 * LANES + k],
        block[GRAIN + 4 * LANES + k],
        block[GRAIN + 5 * LANES + k],
        block[GRAIN + 6 * LANES + k],
        block[GRAIN + 7 * LANES + k],
    )


@device("fast")
def face(block: Float32Array, eye: Vec) -> None:
    """Scale the normals to length 1, and compute the directions to the camera."""
    for k in range(LANES):
        put(block, NORMAL, k, unit(get(block, NORMAL, k)))
        put(block, VIEW, k, unit(sub(eye, get(block, POSITION, k))))
