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
from dataclasses import dataclass, field, replace
from typing import Annotated, Any, Protocol

import numpy as np
import soundfile

from ...core.edits import Add, Edit, Keys
from ...core.speech.audio import Audio, AudioWriter
from ...core.speech.utterance import Utterance
from ...errors import InputError
from ...ports.import_result import ScoreFile
from ...ports.score.score_json import ScoreDocument, score_to_json
from ...reading.hints import Then
from ...reading.schema import placed, within
from ...take import with_profile
from ..session.choices import settings_of
from ..session.revision import LostEdit, Revision
from ..session.scores import parsed, score_file
from ..session.session import Session
from ..session.session_files import SessionFiles
from ..wire import requests, shared
from ..wire.marks import LaneStates, Marker, Markers
from ..wire.messages import encoded, read_message
from ..wire.views import PageView

VERSION = 1
_PLACE = "project"
_BLOCK = 65_536  # samples
_LONGER = 1.0  # s after which a sound is certainly longer than its speech
_KINDS = {cls: kind for kind, cls in requests.EDITS.items()}


def _known_version(version: int) -> int:
    if version != VERSION:
        raise InputError(f"version {version} is not known; expected {VERSION}")
    return version


def _made(members: Mapping[str, object]) -> shared.TakeInputs:
    return read_message(shared.TakeInputs, members)


def _view(members: Mapping[str, object]) -> PageView:
    return read_message(PageView, members)


SavedView = Annotated[PageView, Then(_view, of=Mapping[str, object])]
ProjectVersion = Annotated[int, Then(_known_version)]
SavedMade = Annotated[shared.TakeInputs, Then(_made, of=Mapping[str, object])]


def _lost(members: Mapping[str, object]) -> LostEdit:
    text, edit = members.get("text"), members.get("edit")
    if not isinstance(text, str):
        raise InputError("a lost change has no text; expected 'text'")
    if not isinstance(edit, Mapping | None):
        raise InputError("a lost change is not an object")
    again = None if edit is None else requests.edit_of(edit)
    if not isinstance(again, Add | Keys | None):
        raise InputError("a lost change is not 'add' or 'keys'")
    return LostEdit(text[:200], again)


SavedLost = tuple[Annotated[LostEdit, Then(_lost, of=Mapping[str, object])], ...]
SavedEdits = tuple[requests.AnyEdit, ...]


@dataclass(frozen=True, slots=True)
class RecordingEntry:
    """A recording's name, and its file in base64."""

    name: str
    data: str


@dataclass(frozen=True, slots=True)
class ProjectDocument:
    """A project's file, as it is written; `sound` is a FLAC file in base64."""

    risorius_project: ProjectVersion
    made: SavedMade
    edits: SavedEdits
    score: ScoreDocument
    view: SavedView = field(default_factory=PageView)
    lost: SavedLost = ()
    markers: Markers = ()
    lanes: LaneStates = field(default_factory=LaneStates)
    sound: str | None = None
    recording: RecordingEntry | None = None
    emotions: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    poses: Mapping[str, Mapping[str, float]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Opened:
    """A project that has been opened."""

    version: Revision
    view: PageView


class Changes(Protocol):
    """A user's changes that both kinds of documents save."""

    @property
    def edits(self) -> tuple[Edit, ...]:
        """The edits in order."""

    @property
    def lost(self) -> tuple[LostEdit, ...]:
        """Those that have no place in the score."""

    @property
    def markers(self) -> tuple[Marker, ...]:
        """The markers."""

    @property
    def lanes(self) -> LaneStates:
        """The lanes that are muted, solo and locked."""


def header(version: Revision, view: PageView) -> dict[str, Any]:
    """Return a project's entries beside score and sound."""
    return {
        "risorius_project": VERSION,
        "made": encoded(version.inputs),
        "edits": [_kept_edit(edit) for edit in version.edits],
        "lost": [{"text": it.text, "edit": it.edit and _kept_edit(it.edit)} for it in version.lost],
        "markers": [encoded(marker) for marker in version.markers],
        "lanes": encoded(version.lanes),
        "view": encoded(view),
    }


def _kept_edit(edit: Edit) -> dict[str, Any]:
    return {"kind": _KINDS[type(edit)], **encoded(edit)}


def project_file(session: Session) -> bytes:
    """Return the project as one file. Raises InputError if nothing is performed yet."""
    version, files = session.version(), session.files
    document = header(version, session.view)
    document["score"] = score_to_json(version.base, version.utterance)
    if version.utterance is not None:
        document["sound"] = _flac(version.utterance.audio)
    recording = version.inputs.source.recording
    if recording is not None:
        data = base64.b64encode(files.recording(recording).read_bytes()).decode()
        document["recording"] = {"name": recording, "data": data}
    document["emotions"] = files.emotion_values()
    document["poses"] = dict(files.poses())
    return json.dumps(document, ensure_ascii=False, separators=(",", ":")).encode()


def open_project(data: bytes, files: SessionFiles) -> Opened:
    """Return the project in a file; its sound and recording go to the session's folder.

    Raises InputError or ParameterError, with the path in the file, for what does not fit.
    """
    document = parsed(data, _PLACE)
    project = document.read(ProjectDocument)
    with placed(document.source):
        return _opened(project, files)


def _opened(project: ProjectDocument, files: SessionFiles) -> Opened:
    """Return the opened project; raises MisfitError for a sound or a recording that cannot be used."""
    for name, values in project.emotions.items():
        if name not in files.emotions():
            files.save_emotion(name, dict(values))
    for name, values in project.poses.items():
        files.save_pose(name, dict(values))
    inputs = project.made
    if project.recording is not None:
        with within("recording"):
            inputs = _with_recording(inputs, project.recording, files)
    with within("score"):
        file = score_file(project.score, None)
    with within("sound"):
        utterance = _sounding(file.utterance, project.sound)
    version = version_of(inputs, ScoreFile(file.score, utterance), project, files)
    return Opened(version, project.view)


def version_of(
    inputs: shared.TakeInputs,
    score_file: ScoreFile,
    saved: Changes,
    files: SessionFiles,
) -> Revision:
    """Return the version of a session that a score and the changes in it make."""
    settings = with_profile(settings_of(inputs.choices, files.folder))
    base = score_file.score
    return Revision(
        inputs,
        base,
        base,
        settings,
        score_file.utterance,
        saved.edits,
        lost=saved.lost,
        markers=saved.markers,
        lanes=saved.lanes,
    )


def _with_recording(
    inputs: shared.TakeInputs, recording: RecordingEntry, files: SessionFiles
) -> shared.TakeInputs:
    uploaded = files.temporary(_bytes(recording.data))
    try:
        name = files.add_recording(recording.name, uploaded)
    finally:
        uploaded.unlink(missing_ok=True)
    return replace(inputs, source=replace(inputs.source, recording=name))


def _bytes(text: str) -> bytes:
    try:
        return base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise InputError("is not base64; expected a file in base64") from None


def _flac(audio: Audio) -> str:
    buffer = io.BytesIO()
    soundfile.write(buffer, audio.read(), audio.sample_rate, format="FLAC", subtype="PCM_16")
    return base64.b64encode(buffer.getvalue()).decode()


def _sounding(utterance: Utterance | None, sound: str | None) -> Utterance | None:
    """Return an utterance with its sound, base64 of a FLAC file; silent without one."""
    if utterance is None or sound is None:
        return utterance
    try:
        return replace(utterance, audio=_sound(sound, utterance.duration))
    except ValueError as error:
        raise InputError(
            f"the sound does not fit the speech: {error}; expected one of the same length"
        ) from None


def _sound(text: str, seconds: float) -> Audio:
    """Return a sound; it is read block by block, and no further than the speech lasts."""
    try:
        with soundfile.SoundFile(io.BytesIO(_bytes(text))) as file, AudioWriter(file.samplerate) as writer:
            if file.channels != 1:
                raise InputError("has several channels; expected one")
            for block in file.blocks(_BLOCK, dtype="int16"):
                writer.append(np.asarray(block, np.int16))
                if writer.frames > (seconds + _LONGER) * file.samplerate:
                    raise InputError(f"the sound is longer than the speech; expected {seconds:.2f} s")
            return writer.finish()
    except (RuntimeError, OSError) as error:
        raise InputError(f"is not a sound: {error}; expected a FLAC file") from None
