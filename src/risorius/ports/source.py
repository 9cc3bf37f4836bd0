"""What a writer receives: one performance with everything that can be drawn or measured from it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from ..core.arrays import Array, ByteArray
from ..core.audio import Audio
from ..core.look import Size
from ..core.performance import Performance
from ..core.utterance import Utterance
from ..errors import OutputError

if TYPE_CHECKING:
    from ..face.arkit_fit import ArkitTrack
    from ..face.frame import FaceFrame
    from ..face.head import Head

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Material:
    """A performance ready to be written, with its stages as callables, so that nothing is computed twice.

    `frames()`: the solved faces of all frames in order, one at a time.
    `pictures(size, indices)`: RGB pictures, uint8 of shape (height, width, 3) for size (width, height), or
    RGBA with four channels where their background is transparent, of the frames in `indices` (rising, within
    the performance), one at a time; a picture is only valid until the next one is asked for.
    `measures(frame)`: the numbers of `landmarks_csv.COLUMNS` after `time_s`, in that order.
    `utterance` and `audio` are None where nothing is said. `head()`: the head that performs; `arkit()`: its
    performance as ARKit weights, fitted once; both None where there is no face.
    """

    performance: Performance
    utterance: Utterance | None
    audio: Audio | None
    frames: Callable[[], Iterator[FaceFrame]]
    pictures: Callable[[Size, Sequence[int]], Iterator[ByteArray]]
    measures: Callable[[FaceFrame], Sequence[float] | Array]
    head: Callable[[], Head] | None = None
    arkit: Callable[[], ArkitTrack] | None = None


def needed(make: Callable[[], T] | None) -> T:
    """Return what a writer cannot do without; raise OutputError where the material has no face."""
    if make is None:
        raise OutputError("needs a head, and here is none")
    return make()


@dataclass(frozen=True, slots=True)
class WriteOptions:
    """How outputs are written.

    `size`: width and height of pictures in pixels. `at`: the time in seconds of a single picture, None for
    the middle; `every`: a contact sheet of every so many frames instead. `alpha`: pictures have an alpha
    channel. `voice`: the sound file that a score refers to, None if there is none.
    """

    size: Size = (720, 720)
    at: float | None = None
    every: int | None = None
    alpha: bool = False
    voice: Path | None = None
