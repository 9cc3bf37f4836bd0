"""Scores that a page sends are read like any other, but the sound that they name is never opened."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ...core.score import BlendSettings
from ...errors import InputError, Place
from ...ports.import_result import ScoreFile
from ...ports.score.score_json import ScoreDocument
from ...reading.json_text import JsonDocument, parse_json
from ...reading.schema import placed
from ...settings import BlendChoices
from ...settings.declare import rows
from ..wire.shared import Choices


def parsed(data: bytes | str, name: str) -> JsonDocument:
    """Return a JSON document from the file `name`; raise InputError if it is not JSON."""
    try:
        text = data if isinstance(data, str) else data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            f"is not UTF-8 text (byte {error.start}); expected a JSON file", Place(name)
        ) from None
    return parse_json(text, name)


def read_score(document: JsonDocument, sound: Path | None) -> ScoreFile:
    """Return a score and its utterance; `sound` as in `score_file`. Raises InputError or ParameterError."""
    score = document.read(ScoreDocument)
    with placed(document.source):
        return score_file(score, sound)


def score_file(score: ScoreDocument, sound: Path | None) -> ScoreFile:
    """Return a score and its utterance, with our file `sound` as its sound (silent if None).

    The way to a sound that the score names itself is not followed. Raises as `ScoreDocument.score_file`.
    """
    if score.speech is not None:
        named = None if sound is None else sound.name
        score = replace(score, speech=replace(score.speech, audio=named))
    return score.score_file(Path() if sound is None else sound.parent)


def adopted(choices: Choices, blend: BlendSettings) -> Choices:
    """Return the choices with the blend settings of a score."""
    return replace(choices, **{name: getattr(blend, name) for name in rows(BlendChoices)})
