"""One frame of the face: the solver's result, which renderers and exporters draw."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from ..core.arrays import Array, Float32Array


@dataclass(frozen=True, slots=True, eq=False)
class FrameBuffers:
    """Arrays of a frame that are filled again and again; `FaceFrame` has their shapes."""

    skin: Float32Array
    teeth_lower: Float32Array
    tongue: Float32Array
    wrinkles: Float32Array


@dataclass(frozen=True, slots=True, eq=False)
class FaceFrame:
    """Vertices of one instant, in mm in the head frame, before the head's own rotation.

    skin            (N1, 3) float32, the level-1 skin
    teeth_lower     (n, 3) float32, rotated rigidly with the jaw
    tongue          (n1, 3) float32, the level-1 tongue
    eye_rotation    (2, 3, 3) eye in head, left and right
    head_rotation   (3, 3), about the head's pivot
    jaw_angle       radians, 0 at rest
    wrinkles        (N1, R) float32, heights of folds in mm by region (`face.regions.region_names`)
    parameters      (46,) the values in the parameter table's order that the frame was solved from
    """

    skin: Float32Array
    teeth_lower: Float32Array
    tongue: Float32Array
    eye_rotation: Array
    head_rotation: Array
    jaw_angle: float
    wrinkles: Float32Array
    parameters: Array

    def __repr__(self) -> str:
        """Return one line: the size of its skin."""
        return f"<FaceFrame of {len(self.skin)} vertices of skin>"

    def copy(self) -> FaceFrame:
        """Return a frame with copies of all arrays."""
        arrays = [f.name for f in fields(self) if isinstance(getattr(self, f.name), np.ndarray)]
        return replace(self, **{name: getattr(self, name).copy() for name in arrays})
