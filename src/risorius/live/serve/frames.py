"""Frames as a client wants them: as JSON, or packed."""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arkit import INDEX, ROTATIONS, SHAPES
from ...core.arrays import Array
from ...core.parameters import NAMES
from ...core.speech.audio import Samples
from ...ports.mesh.rig import Rig
from ..frame import LiveFrame
from .messages import FrameFormat, Output

HEADER = struct.Struct("<4sIdIIII")
MAGIC = b"RF01"


@dataclass(frozen=True, slots=True, eq=False)
class SentFrame:
    """A frame, the sound since the one that was sent before it, and how many were dropped between them."""

    frame: LiveFrame
    sound: Samples
    dropped: int


class FrameLayout:
    """The values of a frame by output, and the names of their columns.

    `names`: those of the parameters, of ARKit's shapes, of the rotations, and of the morph targets of `rig`.
    """

    def __init__(self, outputs: Sequence[Output], rig: Rig | None = None) -> None:
        shapes = rig.shape_of if rig else {}
        names = {
            Output.PARAMETERS: NAMES,
            Output.ARKIT: SHAPES,
            Output.ROTATIONS: ROTATIONS,
            Output.RIG: tuple(shapes),
        }
        self.names: dict[Output, tuple[str, ...]] = {output: names[output] for output in outputs}
        self._columns = np.array([INDEX[shape] for shape in shapes.values()], dtype=np.intp)

    @property
    def fits(self) -> bool:
        """Whether frames need weights and rotations."""
        return bool(self.names.keys() - {Output.PARAMETERS})

    def values(self, frame: LiveFrame) -> dict[Output, Array]:
        """Return the values of each output."""
        return {output: self._of(output, frame) for output in self.names}

    def _of(self, output: Output, frame: LiveFrame) -> Array:
        if output is Output.PARAMETERS:
            return frame.values
        assert frame.arkit is not None
        assert frame.rotations is not None
        if output is Output.ROTATIONS:
            return frame.rotations
        return frame.arkit if output is Output.ARKIT else np.asarray(frame.arkit[self._columns])

    def written(self, sent: SentFrame, form: FrameFormat) -> str | bytes:
        """Return a frame as a message."""
        return self._json(sent) if form is FrameFormat.JSON else self._packed(sent)

    def _packed(self, sent: SentFrame) -> bytes:
        """Return the header, the values of the outputs in their order as float32, the sound as int16."""
        frame, values = sent.frame, self.values(sent.frame).values()
        numbers = np.concatenate([np.zeros(0), *values]).astype("<f4")
        counts = sent.dropped, frame.sample_rate, len(numbers), len(sent.sound)
        return b"".join(
            (
                HEADER.pack(MAGIC, frame.index, frame.time, *counts),
                numbers.tobytes(),
                sent.sound.astype("<i2").tobytes(),
            )
        )

    def _json(self, sent: SentFrame) -> str:
        frame = sent.frame
        values = {
            str(output): [round(v, 6) for v in row.tolist()] for output, row in self.values(frame).items()
        }
        return written(
            "frame",
            index=frame.index,
            time=round(frame.time, 6),
            dropped=sent.dropped,
            **values,
            rate=frame.sample_rate,
            sound=base64.b64encode(sent.sound.astype("<i2").tobytes()).decode("ascii"),
        )


def written(kind: str, **about: object) -> str:
    """Return an event as a message."""
    return json.dumps({"is": kind, **about}, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
