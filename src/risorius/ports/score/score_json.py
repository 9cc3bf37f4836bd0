"""`.score.json`: all movements with their causes, to be edited and read back (DESIGN, section 4)."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Annotated, Any

from ...core.movement import LipSegment, ManualCurve, Movement
from ...core.score import BlendSettings, Score, check_score
from ...core.speech.utterance import Utterance
from ...core.units import MAX_SECONDS
from ...errors import InputError, Place
from ...reading.hints import Range, Then
from ...reading.json_text import JsonDocument, load_json
from ...reading.schema import placed, within
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..import_result import ReadOptions, ScoreFile
from ..layout import write_json
from .movement_json import Entry, entry_to_json
from .speech_json import SpeechDocument, speech_to_json

VERSION = 1


def _known_version(version: int) -> int:
    if version != VERSION:
        raise InputError(f"version {version} is not known; expected {VERSION}")
    return version


FormatVersion = Annotated[int, Then(_known_version)]
"""The version of a file; only the one that we write is read."""


@dataclass(frozen=True, slots=True)
class ScoreDocument:
    """A score's file, as it is written."""

    risorius: FormatVersion
    duration: Annotated[float, Range(0.0, MAX_SECONDS)]
    movements: tuple[Entry, ...]
    text: str = ""
    seed: int = 0
    settings: BlendSettings = field(default_factory=BlendSettings)
    speech: SpeechDocument | None = None

    def score_file(self, folder: Path = Path()) -> ScoreFile:
        """Return the score and its utterance; its sound is looked for from `folder` on.

        Raises InputError, ParameterError or MisfitError for what is contradictory, and for a missing sound.
        """
        score = Score(
            duration=self.duration,
            movements=tuple(entry for entry in self.movements if isinstance(entry, Movement)),
            lips=tuple(entry for entry in self.movements if isinstance(entry, LipSegment)),
            manual=tuple(entry for entry in self.movements if isinstance(entry, ManualCurve)),
            settings=self.settings,
            text=self.text,
            seed=self.seed,
        )
        check_score(score)
        if self.speech is None:
            return ScoreFile(score)
        with within("speech"):
            return ScoreFile(score, self.speech.utterance(folder, self.duration))


def write_score_json(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write a take's score, with its speech and the way to `options.voice`."""
    score = take.performance.score
    write_json(path, score_to_json(score, take.utterance, options.voice, path.parent))


def read_score_file(path: Path) -> ScoreFile:
    """Return the score in a file, equal to the one that was written, and its utterance.

    Raises InputError or ParameterError, with the place in the file, for anything unknown, missing, of another
    type, out of range or contradictory, and for a sound that is missing.
    """
    document = load_document(path, "score")
    score = document.read(ScoreDocument)
    with placed(document.source):
        return score.score_file(path.parent)


def load_document(path: Path, expected: str) -> JsonDocument:
    """Return the document in a file; if it holds none, the InputError says what the file is, if known."""
    try:
        return load_json(path)
    except InputError:
        from ...script.kinds import SCORE, kind_of_file

        kind = kind_of_file(path)
        if kind is None or kind == SCORE:
            raise
        raise InputError(f"is not a {expected}: it {kind}", Place(str(path))) from None


def read_score_json(path: Path, _options: ReadOptions) -> ScoreFile:
    """Return the result of `read_score_file`: the table of formats calls this."""
    return read_score_file(path)


def score_to_json(
    score: Score, utterance: Utterance | None = None, voice: Path | None = None, folder: Path = Path()
) -> dict[str, Any]:
    """Return a score as a JSON document; sound is referred to from `folder` on."""
    settings = {name: value for name, value in asdict(score.settings).items() if value is not None}
    entries: tuple[Movement | LipSegment | ManualCurve, ...]
    entries = (*score.movements, *score.lips, *score.manual)
    document: dict[str, Any] = {
        "risorius": VERSION,
        "duration": score.duration,
        "text": score.text,
        "seed": score.seed,
        "settings": settings,
        "movements": [entry_to_json(entry) for entry in entries],
    }
    if utterance is not None:
        document["speech"] = speech_to_json(utterance, voice, folder)
    return document


register(
    ".score.json",
    "all movements with their causes",
    {"movements"},
    write_score_json,
    read_score_json,
    also_read=(".json",),
    order=9,
)
