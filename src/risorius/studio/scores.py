"""Scores that a page sends: read as any, but for the sound that they name, which is never opened."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from ..core.score import BlendSettings
from ..core.setting import rows
from ..errors import InputError
from ..ports.node import Node
from ..ports.readable import ScoreFile
from ..ports.score_json import score_from_json
from ..settings import BlendChoices
from .wire import Choices


def parsed(data: bytes | str) -> Node:
    """Return a JSON document; raise InputError if it is none."""
    try:
        return Node(json.loads(data))
    except (ValueError, RecursionError):
        raise InputError("is not JSON") from None


def score_file(node: Node, sound: Path | None) -> ScoreFile:
    """Return a score and what is said, sounding as the file `sound` of ours (silent where None).

    The way to a sound that the score names itself is not followed. Raises InputError or ParameterError with
    the path in the document.
    """
    document = dict(node.value) if isinstance(node.value, dict) else node.value
    if isinstance(document, dict) and isinstance(document.get("speech"), dict):
        speech = {name: value for name, value in document["speech"].items() if name != "audio"}
        document["speech"] = speech if sound is None else {**speech, "audio": sound.name}
    return score_from_json(Node(document, node.path), Path() if sound is None else sound.parent)


def adopted(choices: Choices, blend: BlendSettings) -> Choices:
    """Return the choices with those of a score on how movements are combined."""
    return replace(choices, **{name: getattr(blend, name) for name in rows(BlendChoices)})
