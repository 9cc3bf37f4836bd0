"""The result of reading a file: a score or a performance, with its utterance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..core.performance import Performance
from ..core.progress import Progress, quiet
from ..core.score import Score
from ..core.speech.utterance import Utterance

if TYPE_CHECKING:
    from ..face.head.head import Head


@dataclass(frozen=True, slots=True)
class ScoreFile:
    """A file's movements or curves as a score, and its utterance (None if nothing is said)."""

    score: Score
    utterance: Utterance | None = None


@dataclass(frozen=True, slots=True)
class PerformanceFile:
    """A file's performance, its curves as written, and its utterance (None if nothing is said)."""

    performance: Performance
    utterance: Utterance | None = None

    @property
    def score(self) -> Score:
        """The movements that the curves were made from."""
        return self.performance.score


PlayedFile = ScoreFile | PerformanceFile


@dataclass(frozen=True, slots=True)
class ReadOptions:
    """Options of a reader, beside the file.

    `head` loads the head that will perform; it is called when the file is known to be right, and only by
    formats that are fitted to a face. `progress` is called before long work. `face`: the number of the face
    in a file that has several.
    """

    head: Callable[[], Head]
    progress: Progress = quiet
    face: int | None = None
