"""Inputs of a writer: a take that can be written, and the options of the outputs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from ..core.look import Size
from ..core.progress import Progress, quiet

if TYPE_CHECKING:
    from ..core.arrays import Array, ByteArray
    from ..core.lips.lip_rig import LipRig
    from ..core.performance import Performance
    from ..core.speech.audio import Audio
    from ..core.speech.utterance import Utterance
    from ..face.fit.arkit_track import ArkitTrack
    from ..face.frame import FaceFrame
    from ..face.head.head import Head


class WritableTake(Protocol):
    """A performance with all that can be drawn or measured from it; each stage runs when it is called.

    The package's `Take` is one. Writers know this protocol alone, so that no format imports the take.
    """

    @property
    def performance(self) -> Performance:
        """The curves and the score that they were made from."""

    @property
    def utterance(self) -> Utterance | None:
        """The utterance; None if nothing is said."""

    @property
    def audio(self) -> Audio | None:
        """The sound that is heard; None for a silent take."""

    @property
    def shown_head(self) -> Head:
        """The head that performs, with the looks that the settings choose."""

    @property
    def head_lips(self) -> LipRig:
        """The fit of the head's lips, which says how far apart muscles bring them; the head isn't loaded."""

    def faces(self, *, progress: Progress = quiet) -> Iterator[FaceFrame]:
        """Yield the solved faces of all frames in order, one at a time."""

    def pictures(self, size: Size, indices: Sequence[int], progress: Progress = quiet) -> Iterator[ByteArray]:
        """Yield pictures of the frames in `indices`, which rise and lie within the performance.

        They are RGB, uint8 of shape (height, width, 3) for `size` (width, height), or RGBA with four
        channels if their background is transparent. A picture is valid until the next one is asked for.
        """

    def reasons(self, time: float) -> Sequence[str]:
        """Return the lines that say why each parameter that moves at a time in seconds has its value."""

    def measures(self, frame: FaceFrame) -> Sequence[float] | Array:
        """Return the numbers of `landmarks_csv.COLUMNS` after `time_s`, in that order."""

    def emotion_curves(self) -> Array:
        """Return the muscles of every frame (frames, 46) as emotions alone would move them."""

    def fit_arkit(self, progress: Progress = quiet) -> ArkitTrack:
        """Return the performance as ARKit weights, fitted once; HeadError if the head has no such shapes."""


@dataclass(frozen=True, slots=True)
class WriteOptions:
    """The options of outputs.

    `size`: width and height of pictures in pixels. `at`: the time in seconds of a single picture, None for
    the middle; `every`: a contact sheet of every n-th frame instead. `names`: the set of expressions of a VRM
    avatar, one of `core.choices.EXPRESSION_NAMES`. `alpha`: pictures have an alpha
    channel; `draft`: films should rather be made soon than be small. `voice`: the sound file that a score
    refers to, None without one. `progress` is called as the frames are made.
    """

    size: Size = (720, 720)
    at: float | None = None
    every: int | None = None
    names: str = "vrm1"
    alpha: bool = False
    draft: bool = False
    voice: Path | None = None
    progress: Progress = quiet
