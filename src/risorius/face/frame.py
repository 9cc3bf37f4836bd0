"""One frame of the face: what the solver makes and renderers and exporters draw."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Array32 = npt.NDArray[np.float32]


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

    skin: Array32
    teeth_lower: Array32
    tongue: Array32
    eye_rotation: Array
    head_rotation: Array
    jaw_angle: float
    wrinkles: Array32
    parameters: Array

    def copy(self) -> FaceFrame:
        """Return a frame that stays as it is, whatever becomes of this one's arrays."""
        arrays = [f.name for f in fields(self) if isinstance(getattr(self, f.name), np.ndarray)]
        return replace(self, **{name: getattr(self, name).copy() for name in arrays})
