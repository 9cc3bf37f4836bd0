"""The geometry of a patch: corners, weights, and the direction to the camera."""

from __future__ import annotations

from ...core.arrays import Float32Array, Int32Array
from ...machine.kernels.jit import device, index
from ...machine.kernels.vec import Vec, sub, unit

Corners = tuple[int, int, int]


@device("fast")
def corners_of(triangles: Int32Array, t: int) -> Corners:
    """Return the vertices of triangle t."""
    return index(triangles[t, 0]), index(triangles[t, 1]), index(triangles[t, 2])


@device("fast")
def weights_of(weights: Float32Array, k: int) -> Vec:
    """Return the place of patch k in its triangle."""
    return weights[k, 0], weights[k, 1], weights[k, 2]


@device("fast")
def towards(eye: Float32Array, p: Vec) -> Vec:
    """Return the unit direction from p to the camera."""
    return unit(sub((eye[0], eye[1], eye[2]), p))


@device("fast")
def put(colours: Float32Array, k: int, colour: Vec) -> None:
    """Set the colour of patch k."""
    colours[k, 0], colours[k, 1], colours[k, 2] = colour
