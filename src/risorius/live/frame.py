"""A frame of a live face, with the sound that is heard during it."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.arrays import Array
from ..core.parameters import NAMES
from ..core.shape_weights import ShapeWeights
from ..core.speech.audio import Samples


@dataclass(frozen=True, slots=True)
class LiveFrame:
    """Frame `index` at `time` seconds, at the parameters' `values`, shape (parameters,).

    `sound`: its samples at `sample_rate`, int16. `text`: the sentence that is being said, "" between them.
    `speaking`: whether something is played, its pauses included.
    If they were asked for, `arkit`: weights (52,) 0..1 in the order of its `names`, by which it can be read,
    too (`frame.arkit["jawOpen"]`); and `rotations`:
    yaw, pitch and roll of head, left and right eye (9,) in radians, to the subject's left, up, tilted left.
    `emotion`: the weights (4,) 0..1 of VRM's presets that emotions alone move; `shut`: by how much the vowels
    among them are less because the lips close, 0..1.
    """

    index: int
    time: float
    values: Array
    sound: Samples
    sample_rate: int
    text: str = ""
    speaking: bool = False
    arkit: ShapeWeights | None = None
    rotations: Array | None = None
    emotion: Array | None = None
    shut: float = 0.0

    def __repr__(self) -> str:
        """Return one line: its number, its time and its sentence."""
        return f"<LiveFrame {self.index} at {self.time:.3f} s, {self.text!r}>"

    @property
    def parameters(self) -> dict[str, float]:
        """The values by the parameters' names."""
        return dict(zip(NAMES, self.values.tolist(), strict=True))
