"""A take: a performance that can be looked at, explained and written."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import astuple, dataclass, field
from functools import cached_property, partial
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from .core.performance import Performance
from .core.score import Score
from .core.utterance import Utterance
from .settings import Settings

if TYPE_CHECKING:
    from .face.frame import FaceFrame
    from .face.head import Head
    from .face.measure import Gauge
    from .face.solve import FaceSolver
    from .out import Material
    from .out.source import Picture, Size

Progress = Callable[..., None]
"""Called with a stage's name, and how many of how many frames are done where that is known."""


def quiet(stage: str, done: int = 0, total: int = 0) -> None:
    """Say nothing."""


@dataclass
class Take:
    """What `speak`, `mix` and `pose` return.

    `utterance` is None where nothing is said. Faces and pictures are made when they are asked for, one frame
    at a time.
    """

    performance: Performance
    settings: Settings = field(default_factory=Settings)
    utterance: Utterance | None = None

    @property
    def score(self) -> Score:
        """All movements with their causes."""
        return self.performance.score

    @property
    def duration(self) -> float:
        """Seconds."""
        return self.performance.duration

    @property
    def times(self) -> npt.NDArray[np.float64]:
        """Frame times in seconds, shape (frames,)."""
        return self.performance.times

    @property
    def curves(self) -> dict[str, npt.NDArray[np.float64]]:
        """One curve per parameter by name, each of shape (frames,)."""
        return self.performance.curves

    def write(self, *paths: str | PathLike[str], progress: Progress = quiet) -> None:
        """Write files, what each holds being said by its suffix; all appear when the last is complete.

        Raises OutputError if a file cannot be written; then none is.
        """
        from .out import WriteOptions, check_targets, write_targets

        options = WriteOptions(self.settings.size, self.settings.at, self.settings.every)
        write_targets(self._material(progress), check_targets(paths), options)

    def faces(self, indices: Sequence[int] | None = None) -> Iterator[FaceFrame]:
        """Yield the face of every frame, or of the frames in `indices`, one at a time."""
        chosen = range(len(self.performance.values)) if indices is None else indices
        return (self._solver.solve(self.performance.values[i]) for i in chosen)

    def pictures(
        self, size: Size | None = None, indices: Sequence[int] | None = None, progress: Progress = quiet
    ) -> Iterator[Picture]:
        """Yield RGB pictures, uint8 (height, width, 3); each is valid until the next is asked for."""
        from .render import Renderer

        chosen = range(len(self.performance.values)) if indices is None else indices
        renderer = Renderer(self.head, size or self.settings.size)
        for done, face in enumerate(self.faces(chosen)):
            yield renderer.render(face)
            progress("Drawing", done + 1, len(chosen))

    def _material(self, progress: Progress) -> Material:
        from .out import Material

        return Material(
            performance=self.performance,
            utterance=self.utterance,
            audio=self.utterance.audio if self.utterance else None,
            frames=self.faces,
            pictures=partial(self.pictures, progress=progress),
            measures=self._measured,
        )

    def _measured(self, face: FaceFrame) -> list[float]:
        measures = astuple(self._gauge.measure(face))
        return [*measures, *self._gauge.landmarks(face).ravel().tolist()]

    @cached_property
    def _gauge(self) -> Gauge:
        from .face.measure import Gauge

        return Gauge(self.head)

    @cached_property
    def head(self) -> Head:
        """The head that performs; raises HeadError if it cannot be loaded."""
        from .face.head import load_head

        return load_head(self.settings.head)

    @cached_property
    def _solver(self) -> FaceSolver:
        from .face.solve import FaceSolver

        return FaceSolver(self.head, age=self.settings.age, wrinkles=self.settings.wrinkles)
