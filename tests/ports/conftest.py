"""Small takes: performances with pictures and sound that need no face."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from risorius.core.arrays import Array, ByteArray, Int16Array
from risorius.core.audio import Audio, AudioWriter
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.core.performance import Performance, frame_times
from risorius.core.score import Score
from risorius.core.utterance import Utterance
from risorius.ports.landmarks_csv import COLUMNS
from risorius.ports.source import Material

MaterialMaker = Callable[..., Material]
Pictures = Callable[[tuple[int, int], Sequence[int]], Iterator[ByteArray]]


def _grey_pictures(size: tuple[int, int], indices: Sequence[int]) -> Iterator[ByteArray]:
    """Yield one array again and again, as a renderer with its own buffer does."""
    picture = np.empty((size[1], size[0], 3), np.uint8)
    for index in indices:
        picture[:] = 10 + index % 200
        yield picture


@pytest.fixture
def material_of() -> MaterialMaker:
    """Return a function that makes a material: a smile that rises over `duration`."""

    def make(
        duration: float = 1.0,
        fps: Fraction = Fraction(30),
        audio: Audio | None = None,
        utterance: Utterance | None = None,
        pictures: Pictures = _grey_pictures,
        score: Score | None = None,
    ) -> Material:
        times = frame_times(duration, fps)
        values = np.tile(NEUTRAL, (len(times), 1))
        values[:, INDEX["zygomatic_major.left"]] = np.minimum(times / duration, 1.0)
        values[:, INDEX["head_yaw"]] = -times / duration * 10.0

        def measures(frame: Any) -> Array:
            return np.full(len(COLUMNS) - 1, float(frame))

        return Material(
            Performance(score or Score(duration), fps, values),
            utterance,
            audio,
            lambda: iter(range(len(times))),  # type: ignore[arg-type]
            pictures,
            measures,
        )

    return make


@pytest.fixture
def sound_of() -> Callable[..., Audio]:
    """Return a function from samples to a sound."""

    def make(samples: Int16Array, rate: int = 22_050) -> Audio:
        with AudioWriter(rate) as writer:
            writer.append(samples)
            return writer.finish()

    return make
