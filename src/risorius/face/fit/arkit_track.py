"""A performance in ARKit's terms: weights of the 52 shapes, head and eyes, frame by frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core.arkit import SHAPES
from ...core.arrays import Array
from ...core.shape_weights import shape_index
from ...machine.optional import optional


@dataclass(frozen=True, slots=True, eq=False)
class ArkitTrack:
    """A performance in ARKit's terms, frame by frame.

    weights  (frames, 52) 0..1 in the order of `core.arkit.SHAPES`
    head     (frames, 3) yaw, pitch, roll of the head in degrees: to the subject's left, up, tilted left
    eyes     (frames, 2, 3) the same of the left and the right eye in the head; no roll
    rms      (frames,) mm between the weights' skin and the face, over the vertices that shapes move
    worst    (frames,) mm of the vertex that fits worst
    times    (frames,) seconds, None if they are not known
    """

    weights: Array
    head: Array
    eyes: Array
    rms: Array
    worst: Array
    times: Array | None = None

    def __repr__(self) -> str:
        """Return one line: the number of frames, and the distances that the weights leave."""
        rms, worst = self.residual
        return f"<ArkitTrack of {len(self.weights)} frames, {rms:.2f} mm off, at worst {worst:.1f} mm>"

    @property
    def names(self) -> tuple[str, ...]:
        """ARKit's names of the shapes, in the order of `weights`."""
        return SHAPES

    def __getitem__(self, name: str) -> Array:
        """Return the weights of one shape (frames,); raise ParameterError for an unknown name."""
        return self.weights[:, shape_index(name)]

    def to_pandas(self) -> Any:
        """Return the weights as a `pandas.DataFrame`: a row a frame, indexed by `time_s`, a column a shape.

        Without times the index is the frame's number. Raises RisoriusError if pandas is not installed.
        """
        pandas = optional("pandas", "pandas")
        if self.times is None:
            index = pandas.RangeIndex(len(self.weights), name="frame")
        else:
            index = pandas.Index(self.times, name="time_s")
        return pandas.DataFrame(self.weights.copy(), index=index, columns=list(SHAPES))

    @property
    def rotations(self) -> Array:
        """Yaw, pitch and roll of head, left and right eye (frames, 9) in radians."""
        angles = np.concatenate([self.head[:, None], self.eyes], axis=1)
        return np.asarray(np.radians(angles).reshape(len(angles), -1))

    @property
    def residual(self) -> tuple[float, float]:
        """The root mean square over all frames and the worst vertex, in mm."""
        return float(np.sqrt((self.rms**2).mean())), float(self.worst.max())
