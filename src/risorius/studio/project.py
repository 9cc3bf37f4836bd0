"""The project: a session as one file that opens again exactly, and as it is saved after each change.

Both are JSON: `risorius_project` 1, `made` (script, choices, emotions), `edits` in order, `score` as it was
planned (with what is said), `view`. In the file that a user keeps all stands in one: the sound as FLAC, the
recording, the emotions and poses saved under a name. In the session's folder score and sound lie beside.
"""

from __future__ import annotations

import base64
import binascii
import io
import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import soundfile

from ..core.audio import Audio, AudioWriter
from ..core.schema import Source, build
from ..core.utterance import Utterance
from ..errors import InputError
from ..pipeline import with_profile
from ..ports.node import Node
from ..ports.readable import ScoreFile
from ..ports.score_json import score_to_json
from . import wire
from .choices import settings_of
from .messages import encoded, without_nulls
from .scores import parsed, score_file
from .session import Session
from .session_files import SessionFiles
from .version import Version

VERSION = 1
_KEYS = ("risorius_project", "made", "edits", "score", "view", "sound", "recording", "emotions", "poses")
_REQUIRED = ("risorius_project", "made", "edits", "score")
_PLACE = "project"
_KINDS = {cls: kind for kind, cls in wire.EDITS.items()}


@dataclass(frozen=True, slots=True)
class Opened:
    """What a project holds."""

    version: Version
    view: dict[str, object]


def header(version: Version, view: Mapping[str, object]) -> dict[str, Any]:
    """Return what a project says beside score and sound."""
    return {
        "risorius_project": VERSION,
        "made": encoded(version.made),
        "edits": [{"kind": _KINDS[type(edit)], **encoded(edit)} for edit in version.edits],
        "view": dict(view),
    }


def project_file(session: Session) -> bytes:
    """Return the project as one file. Raises InputError where nothing is performed yet."""
    version, files = session.version(), session.files
    document = header(version, session.view)
    document["score"] = score_to_json(version.base, version.utterance)
    if version.utterance is not None:
        document["sound"] = _flac(version.utterance.audio)
    recording = version.made.source.recording
    if recording is not None:
        data = base64.b64encode(files.recording(recording).read_bytes()).decode()
        document["recording"] = {"name": recording, "data": data}
    document["emotions"] = files.emotion_values()
    document["poses"] = dict(files.poses())
    return json.dumps(document, ensure_ascii=False, separators=(",", ":")).encode()


def open_project(data: bytes, files: SessionFiles) -> Opened:
    """Return what a project file holds; its sound and recording go to the session's folder.

    Raises InputError or ParameterError, with the path in the file, for what does not fit.
    """
    entries = _entries(data)
    for name, values in _members(entries, "emotions"):
        if name not in files.emotions():
            files.save_emotion(name, values)
    for name, values in _members(entries, "poses"):
        files.save_pose(name, values)
    made = made_from(entries["made"])
    if "recording" in entries:
        made = _with_recording(made, entries["recording"], files)
    sound = _sound(entries["sound"]) if "sound" in entries else None
    held = score_file(entries["score"], None)
    utterance = held.utterance
    if utterance is not None and sound is not None:
        with entries["sound"].located():
            utterance = _sounding(utterance, sound)
    return Opened(version_of(made, ScoreFile(held.score, utterance), entries, files), view_of(entries))


def _entries(data: bytes) -> dict[str, Node]:
    entries = parsed(data).entries(_KEYS, _REQUIRED)
    check_version(entries["risorius_project"])
    return entries


def check_version(node: Node) -> None:
    """Raise InputError unless a project is of the version that we write."""
    if node.integer() != VERSION:
        raise node.fault(f"version {node.value} is not known; expected {VERSION}")


def made_from(node: Node) -> wire.Made:
    """Return how a take came about; raise InputError for what does not fit."""
    members = {name: member.value for name, member in node.members().items()}
    return build(wire.Made, without_nulls(members), Source(_PLACE))


def edits_from(node: Node) -> tuple[wire.Edit, ...]:
    """Return edits; raise InputError for one that is none."""
    return tuple(_edit(item) for item in node.items())


def _edit(node: Node) -> wire.Edit:
    members = {name: member.value for name, member in node.members().items()}
    kind = members.pop("kind", None)
    if not isinstance(kind, str) or kind not in wire.EDITS:
        raise node.fault(f"'{kind}' is no kind of edit; expected one of {', '.join(wire.EDITS)}")
    with node.located():
        edit: wire.Edit = build(wire.EDITS[kind], without_nulls(members), Source(_PLACE))
        return edit


def version_of(made: wire.Made, held: ScoreFile, entries: Mapping[str, Node], files: SessionFiles) -> Version:
    """Return the version that a project describes."""
    settings = settings_of(made.choices, files.folder)
    settings = with_profile(settings)
    edits = edits_from(entries["edits"])
    return Version(made, held.score, held.score, settings, held.utterance, edits)


def view_of(entries: Mapping[str, Node]) -> dict[str, object]:
    """Return what the page kept of itself."""
    view = entries["view"].value if "view" in entries else {}
    return view if isinstance(view, dict) else {}


def _members(entries: Mapping[str, Node], name: str) -> list[tuple[str, dict[str, float]]]:
    if name not in entries:
        return []
    rows = entries[name].members()
    return [(key, {n: v.number() for n, v in row.members().items()}) for key, row in rows.items()]


def _with_recording(made: wire.Made, node: Node, files: SessionFiles) -> wire.Made:
    entries = node.entries(("name", "data"), ("name", "data"))
    with node.located():
        uploaded = files.temporary(_bytes(entries["data"]))
        try:
            name = files.add_recording(entries["name"].text(), uploaded)
        finally:
            uploaded.unlink(missing_ok=True)
    return replace(made, source=replace(made.source, recording=name))


def _bytes(node: Node) -> bytes:
    try:
        return base64.b64decode(node.text(), validate=True)
    except (binascii.Error, ValueError):
        raise node.fault("is not base64") from None


def _flac(audio: Audio) -> str:
    buffer = io.BytesIO()
    soundfile.write(buffer, audio.read(), audio.sample_rate, format="FLAC", subtype="PCM_16")
    return base64.b64encode(buffer.getvalue()).decode()


def _sound(node: Node) -> Audio:
    try:
        samples, rate = soundfile.read(io.BytesIO(_bytes(node)), dtype="int16")
    except (RuntimeError, OSError) as error:
        raise node.fault(f"is no sound: {error}") from None
    if samples.ndim != 1:
        raise node.fault("has several channels; expected one")
    with AudioWriter(rate) as writer:
        writer.append(np.asarray(samples, np.int16))
        return writer.finish()


def _sounding(utterance: Utterance, sound: Audio) -> Utterance:
    try:
        return replace(utterance, audio=sound)
    except ValueError as error:
        raise InputError(f"the sound does not fit what is said: {error}") from None
