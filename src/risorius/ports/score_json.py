"""`.score.json`: all movements with their causes, to be edited and read back (DESIGN, section 4)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, TypeVar

from ..core.functions import ONSET_FUNCTIONS
from ..core.movement import LipSegment, ManualCurve, Movement
from ..core.score import BlendSettings, Score, check_score
from ..core.utterance import Utterance
from ..errors import Place, RisoriusError
from .formats import register
from .layout import write_json
from .movement_json import Entry, entry_from_json, entry_to_json
from .node import Node, load
from .readable import ReadOptions, ScoreFile
from .records import from_record
from .speech_json import speech_from_json, speech_to_json
from .writable import WritableTake, WriteOptions

T = TypeVar("T")

VERSION = 1
# A day; longer is a slip of the pen, and would only fail later.
MAX_SECONDS = 86_400.0
_KEYS = ("risorius", "duration", "text", "seed", "settings", "movements", "speech")
_REQUIRED = ("risorius", "duration", "movements")


def write_score_json(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write a take's score, with its speech and the way to `options.voice`."""
    score = take.performance.score
    write_json(path, score_to_json(score, take.utterance, options.voice, path.parent))


def read_score(path: Path) -> Score:
    """Return the score in a file, equal to the one that was written; what is said is not looked at.

    Raises InputError or ParameterError, with the file and the path in it, for anything unknown, missing, of
    another type, out of range or contradictory.
    """
    return reading(path, lambda node: score_from_json(node, path.parent, speech=False)).score


def read_score_file(path: Path) -> ScoreFile:
    """Return the score and what is said in it. Raises as `read_score`, also if a sound is missing."""
    return reading(path, lambda node: score_from_json(node, path.parent))


def read_score_json(path: Path, _options: ReadOptions) -> ScoreFile:
    """Return what `read_score_file` does: the table of formats calls this."""
    return read_score_file(path)


def reading(path: Path, make: Callable[[Node], T]) -> T:
    """Return `make` of the document in a file; errors get the file's name."""
    node = load(path)
    try:
        return make(node)
    except RisoriusError as error:
        raise error.at(Place(str(path))) from None


def score_to_json(
    score: Score, utterance: Utterance | None = None, voice: Path | None = None, folder: Path = Path()
) -> dict[str, Any]:
    """Return a score as a JSON document; sound is referred to from `folder` on."""
    settings = {name: value for name, value in asdict(score.settings).items() if value is not None}
    entries: tuple[Entry, ...] = (*score.movements, *score.lips, *score.manual)
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


def score_from_json(node: Node, folder: Path = Path(), *, speech: bool = True) -> ScoreFile:
    """Return what a JSON document describes. Raises as `read_score`, without the file's name."""
    entries = node.entries(_KEYS, _REQUIRED)
    check_version(entries["risorius"])
    made = [entry_from_json(item) for item in entries["movements"].items()]
    score = Score(
        duration=entries["duration"].number(0.0, MAX_SECONDS),
        movements=tuple(entry for entry in made if isinstance(entry, Movement)),
        lips=tuple(entry for entry in made if isinstance(entry, LipSegment)),
        manual=tuple(entry for entry in made if isinstance(entry, ManualCurve)),
        settings=_settings(entries["settings"]) if "settings" in entries else BlendSettings(),
        text=entries["text"].text() if "text" in entries else "",
        seed=entries["seed"].integer() if "seed" in entries else 0,
    )
    check_score(score)
    spoken = entries.get("speech") if speech else None
    utterance = None if spoken is None else speech_from_json(spoken, folder, score.duration)
    return ScoreFile(score, utterance)


def check_version(node: Node) -> None:
    """Raise InputError unless a document is of the version that we write."""
    if node.integer() != VERSION:
        raise node.fault(f"version {node.value} is not known; expected {VERSION}")


def _settings(node: Node) -> BlendSettings:
    settings = from_record(BlendSettings, node)
    entries = node.entries([f.name for f in fields(BlendSettings)])
    for name in ("activation_threshold", "min_onset", "min_offset"):
        if getattr(settings, name) is not None:
            entries[name].number(0.0, 1.0 if name == "activation_threshold" else float("inf"))
    if settings.onset_function is not None:
        with entries["onset_function"].located():
            ONSET_FUNCTIONS.get(settings.onset_function)
    return settings


register(
    ".score.json",
    "all movements with their causes",
    {"movements"},
    write_score_json,
    read_score_json,
    also_read=(".json",),
    order=9,
)
