"""A frame of a live face, with the sound that is heard during it."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.arrays import Array
from ..core.audio import Samples
from ..core.parameters import NAMES


@dataclass(frozen=True, slots=True)
class LiveFrame:
    """Frame `index` at `time` seconds, at the parameters' `values`, shape (parameters,).

    `sound`: its samples at `sample_rate`, int16. `text`: the sentence that is being said, "" between them.
    """

    index: int
    time: float
    values: Array
    sound: Samples
    sample_rate: int
    text: str = ""

    @property
    def parameters(self) -> dict[str, float]:
        """The values by the parameters' names."""
        return dict(zip(NAMES, self.values.tolist(), strict=True))
