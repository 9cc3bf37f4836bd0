"""The camera: a portrait lens, and the projection of points into the picture."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core.arrays import Array, Float32Array, Int32Array
from ..errors import InputError
from ..machine.kernels.jit import device, f4, i4, kernel
from .raster import SUBPIXEL

Coordinates = tuple[float, float, float]
_FAR = f4(1 << 22)  # snapped positions stay within ±16384 samples, so that edge products fit in 64 bits
_NEAREST = f4(1.0)  # mm: nearer points are projected as if they were at this distance


@dataclass(frozen=True, slots=True)
class Camera:
    """A pinhole camera in the head frame: its place and its target in mm, and its angle of view.

    `field_of_view` is the vertical angle in degrees. A portrait lens (85 to 100 mm on full frame) has 14° to
    16° over the short side; a nearer camera with a wider angle enlarges the nose.
    """

    eye: Coordinates
    target: Coordinates
    field_of_view: float = 16.0

    def __post_init__(self) -> None:
        if not 1.0 <= self.field_of_view <= 120.0:
            raise InputError(f"field of view {self.field_of_view:g}; expected 1 to 120 degrees")
        if math.dist(self.eye, self.target) < 1.0:
            raise InputError("the camera stands on its target; expected at least 1 mm between them")
        if math.hypot(self.eye[0] - self.target[0], self.eye[2] - self.target[2]) < 1e-3:
            raise InputError("the camera looks straight up or down; expected a direction that has a side")

    def axes(self) -> Array:
        """Return the camera's axes as rows (3, 3): right, up, and backward (towards the camera)."""
        backward = np.subtract(self.eye, self.target, dtype=np.float64)
        backward /= np.linalg.norm(backward)
        right = np.cross((0.0, 1.0, 0.0), backward)
        right /= np.linalg.norm(right)
        return np.stack([right, np.cross(backward, right), backward])

    def focal(self, height: int) -> float:
        """Return the focal length in units of samples for a picture of this many rows."""
        return 0.5 * height / math.tan(math.radians(self.field_of_view) / 2)

    def matrix(self, width: int, height: int) -> Float32Array:
        """Return the projection (3, 4) float32: its rows give x·d and y·d in samples, and the distance d."""
        axes, focal = self.axes(), self.focal(height)
        rows = np.stack(
            [
                focal * axes[0] - 0.5 * width * axes[2],
                -focal * axes[1] - 0.5 * height * axes[2],
                -axes[2],
            ]
        )
        return np.concatenate([rows, -(rows @ np.asarray(self.eye))[:, None]], axis=1).astype(np.float32)

    def millimetres_per_sample(self, height: int) -> float:
        """Return the size of one sample at the target's distance."""
        return math.dist(self.eye, self.target) / self.focal(height)


def portrait(top: float, bottom: float, centre: Coordinates, field_of_view: float = 16.0) -> Camera:
    """Return a camera whose picture reaches from `bottom` to `top` (mm, heights) in the depth of `centre`."""
    if top <= bottom:
        raise InputError(f"the frame's top {top:g} lies below its bottom {bottom:g}")
    middle = 0.5 * (top + bottom)
    distance = 0.5 * (top - bottom) / math.tan(math.radians(field_of_view) / 2)
    target = (centre[0], middle, centre[2])
    return Camera((centre[0], middle, centre[2] + distance), target, field_of_view)


@device()
def snap(position: float) -> int:
    """Return a position in samples as the nearest 1/256 sample."""
    return i4(math.floor(max(min(position * f4(SUBPIXEL), _FAR), -_FAR) + f4(0.5)))


@kernel("f4[:, :], f4[:, :], i4[:, :], f4[:]")
def project(points: Float32Array, matrix: Float32Array, xy: Int32Array, key: Float32Array) -> None:
    """Write positions in 1/256 sample and keys (1 / distance) of points (n, 3) for `Camera.matrix`."""
    for i in range(len(points)):
        _project(points, matrix, i, xy, key)


@kernel("f4[:, :], f4[:, :], i4[:], i4[:, :], f4[:]")
def project_pairs(
    points: Float32Array, matrix: Float32Array, pairs: Int32Array, xy: Int32Array, key: Float32Array
) -> None:
    """Project only the points `pairs` (k,) and the next of each."""
    for i in pairs:
        _project(points, matrix, i, xy, key)
        _project(points, matrix, i + 1, xy, key)


@device()
def _project(points: Float32Array, matrix: Float32Array, i: int, xy: Int32Array, key: Float32Array) -> None:
    x, y, z = points[i, 0], points[i, 1], points[i, 2]
    d = matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2] * z + matrix[2, 3]
    k = f4(1) / max(d, _NEAREST)
    u = (matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2] * z + matrix[0, 3]) * k
    v = (matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2] * z + matrix[1, 3]) * k
    xy[i, 0] = snap(u)
    xy[i, 1] = snap(v)
    key[i] = k
