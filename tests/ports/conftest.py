"""Small takes: performances with pictures and sound that need no face."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from risorius.core.arrays import Array, ByteArray, Int16Array
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.core.performance import Performance, frame_times
from risorius.core.progress import Progress, quiet
from risorius.core.score import Score
from risorius.core.speech.audio import Audio, AudioWriter
from risorius.core.speech.utterance import Utterance
from risorius.ports.curves.landmarks_csv import COLUMNS
from risorius.ports.export_source import WritableTake

if TYPE_CHECKING:
    from risorius.core.lips.lip_rig import LipRig
    from risorius.face.fit.arkit_track import ArkitTrack
    from risorius.face.head.head import Head

TakeMaker = Callable[..., WritableTake]
Pictures = Callable[[tuple[int, int], Sequence[int]], Iterator[ByteArray]]


def _grey_pictures(size: tuple[int, int], indices: Sequence[int]) -> Iterator[ByteArray]:
    """Yield one array again and again, as a renderer with its own buffer does."""
    picture = np.empty((size[1], size[0], 3), np.uint8)
    for index in indices:
        picture[:] = 10 + index % 200
        yield picture


@dataclass
class SmallTake:
    """A take without a face: its faces are the frames' numbers, and its measures repeat them."""

    performance: Performance
    utterance: Utterance | None = None
    audio: Audio | None = None
    draw: Pictures = _grey_pictures
    face_count: int | None = None
    measure_count: int = len(COLUMNS) - 1

    @property
    def shown_head(self) -> Head:
        raise AssertionError("a small take has no head")

    @property
    def head_lips(self) -> LipRig:
        raise AssertionError("a small take has no head")

    def faces(self, *, progress: Progress = quiet) -> Iterator[Any]:
        yield from range(len(self.performance.values) if self.face_count is None else self.face_count)

    def pictures(
        self, size: tuple[int, int], indices: Sequence[int], progress: Progress = quiet
    ) -> Iterator[ByteArray]:
        return self.draw(size, indices)

    def reasons(self, time: float) -> Sequence[str]:
        return (f"reasons at {time:g} s",)

    def measures(self, frame: Any) -> Array:
        return np.full(self.measure_count, float(frame))

    def emotion_curves(self) -> Array:
        return np.tile(NEUTRAL, (len(self.performance.values), 1))

    def fit_arkit(self, progress: Progress = quiet) -> ArkitTrack:
        raise AssertionError("a small take has no head")


@pytest.fixture
def take_of() -> TakeMaker:
    """Return a function that makes a take: a smile that rises over `duration`."""

    def make(
        duration: float = 1.0,
        fps: Fraction = Fraction(30),
        audio: Audio | None = None,
        utterance: Utterance | None = None,
        pictures: Pictures = _grey_pictures,
        score: Score | None = None,
    ) -> WritableTake:
        times = frame_times(duration, fps)
        values = np.tile(NEUTRAL, (len(times), 1))
        values[:, INDEX["zygomatic_major.left"]] = np.minimum(times / duration, 1.0)
        values[:, INDEX["head_yaw"]] = -times / duration * 10.0
        return SmallTake(Performance(score or Score(duration), fps, values), utterance, audio, pictures)

    return make


@pytest.fixture
def sound_of() -> Callable[..., Audio]:
    """Return a function from samples to a sound."""

    def make(samples: Int16Array, rate: int = 22_050) -> Audio:
        with AudioWriter(rate) as writer:
            writer.append(samples)
            return writer.finish()

    return make
