"""What a patch of surface looks like to its material: place, normal, and direction to the camera."""

from __future__ import annotations

from ..inputs import Batch, Mesh, Sight
from ..jit import device
from ..vec import Vec, sub, unit, weigh

Corners = tuple[int, int, int]


@device
def corners_of(mesh: Mesh, t: int) -> Corners:
    """Return the vertices of triangle t."""
    return mesh.triangles[t, 0], mesh.triangles[t, 1], mesh.triangles[t, 2]


@device
def weights_of(batch: Batch, turn: int, k: int) -> Vec:
    """Return the place of patch k in its triangle."""
    return batch.weights[turn, k, 0], batch.weights[turn, k, 1], batch.weights[turn, k, 2]


@device
def place_of(mesh: Mesh, sight: Sight, corners: Corners, weights: Vec) -> tuple[Vec, Vec, Vec]:
    """Return position, unit normal and unit direction to the camera."""
    p = weigh(mesh.positions, corners, weights, 0)
    view = unit(sub((sight.eye[0], sight.eye[1], sight.eye[2]), p))
    return p, unit(weigh(mesh.normals, corners, weights, 0)), view


@device
def put(batch: Batch, turn: int, k: int, colour: Vec) -> None:
    """Set the colour of patch k."""
    batch.colour[turn, k, 0], batch.colour[turn, k, 1], batch.colour[turn, k, 2] = colour
