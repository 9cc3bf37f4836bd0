"""Channels averaged to one; if they cancel each other out, the loudest alone.

It imports nothing of Risorius: the worker that decodes films loads it, too (`film_worker`).
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

# The share of the channels' power that is left of their mean if they cancel each other out: two copies of a
# voice, one of them inverted. Of two sounds that have nothing in common half is left.
_CANCELLED = 0.1
# Mean power of a block in which something sounds: -50 dB of full scale.
_LOUD = 1e-5

_Samples = npt.NDArray[np.float32]


class Mixdown:
    """The mean of several channels, block by block; from where they cancel each other out, one of them."""

    def __init__(self) -> None:
        self._channel: int | None = None

    def mono(self, block: _Samples) -> _Samples:
        """Return a block (n, channels), at best of a second or more, as one channel (n,)."""
        if block.shape[1] == 1:
            return np.asarray(block[:, 0])
        if self._channel is None:
            mean = np.asarray(block.mean(axis=1, dtype=np.float32))
            if not _cancelled(block, mean):
                return mean
            self._channel = int(np.square(block, dtype=np.float64).mean(axis=0).argmax())
        return np.asarray(block[:, self._channel])


def _cancelled(block: _Samples, mean: _Samples) -> bool:
    """Tell whether the channels of a loud block (n, channels) cancel each other out in their mean."""
    if not len(block):
        return False
    power = float(np.square(block, dtype=np.float64).mean())
    return power > _LOUD and float(np.square(mean, dtype=np.float64).mean()) < _CANCELLED * power
