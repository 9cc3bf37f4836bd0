"""A session saved by itself: `project.json` after each change, the score and the sound beside it once."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from ...core.speech.audio import AudioWriter
from ...errors import RisoriusError
from ...machine.atomic import replacing
from ...ports.import_result import ScoreFile
from ...ports.layout import write_json
from ...ports.score.score_json import score_to_json
from ...reading.schema import MisfitError
from ..session.revision import Revision
from ..session.scores import parsed, read_score
from ..session.session import Session
from ..session.session_files import SessionFiles, digest, write_text
from ..wire.marks import LaneStates, Markers
from ..wire.messages import encoded, read_message
from ..wire.shared import TakeInputs
from ..wire.views import PageView
from .project import Opened, ProjectVersion, SavedEdits, SavedLost, SavedMade, header, version_of

FILE = "project.json"
DRAFT = "draft.json"


@dataclass(frozen=True, slots=True)
class AutosaveDocument:
    """The saved state of a session: `score` and `sound` are the names of files beside it."""

    risorius_project: ProjectVersion
    made: SavedMade
    edits: SavedEdits
    view: Mapping[str, object]
    score: str
    lost: SavedLost = ()
    markers: Markers = ()
    lanes: LaneStates = field(default_factory=LaneStates)
    sound: str | None = None
    take: int = 0


@dataclass(frozen=True, slots=True)
class DraftDocument:
    """A draft: text that is written but not performed."""

    draft: SavedMade


class Autosave:
    """Keeps a session's folder as the session is. `loaded` says once how the last one was found."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._base: object = None
        self._draft: TakeInputs | None = None
        self._beside: dict[str, str | None] = {}

    def save(self, session: Session) -> None:
        """Save the draft and the present version, if any. Raises OutputError if the disk does not take it."""
        self._save_draft(session.draft)
        version = session.history.present
        if version is None:
            return
        if self._base is not version.base:
            self._beside = self._save_base(version)
            self._base = version.base
        document = {**header(version, session.view), **self._beside, "take": session.last_number}
        write_text(self._folder / FILE, json.dumps(document, ensure_ascii=False))
        self._tidy()

    def _save_draft(self, draft: TakeInputs | None) -> None:
        if draft == self._draft:
            return
        path = self._folder / DRAFT
        if draft is None:
            path.unlink(missing_ok=True)
        else:
            write_text(path, json.dumps({"draft": encoded(draft)}, ensure_ascii=False))
        self._draft = draft

    def _save_base(self, version: Revision) -> dict[str, str | None]:
        sound = None
        if version.utterance is not None:
            source = version.utterance.audio.path
            sound = self._folder / f"voice-{digest(source.read_bytes())}.wav"
            if not sound.exists():
                with replacing(sound) as beside:
                    shutil.copyfile(source, beside)
        document = score_to_json(version.base, version.utterance, sound, self._folder)
        name = f"score-{digest(json.dumps(document).encode())}.json"
        with replacing(self._folder / name) as beside:
            write_json(beside, document)
        return {"score": name, "sound": None if sound is None else sound.name}

    def _tidy(self) -> None:
        """Remove scores and sounds that the project does not name any more."""
        for pattern in ("score-*.json", "voice-*.wav"):
            for path in self._folder.glob(pattern):
                if path.name not in self._beside.values():
                    path.unlink(missing_ok=True)

    def load(self, session: Session) -> tuple[str, ...]:
        """Restore the saved state, if any; return the error, if any, after which the file is put aside."""

        def project(path: Path) -> None:
            opened, number = self._read(path, session.files)
            session.restore(opened.version, opened.view, number)

        def draft(path: Path) -> None:
            session.draft = self._draft = parsed(path.read_bytes(), DRAFT).read(DraftDocument).draft

        return (*self._taken_up(FILE, "project", project), *self._taken_up(DRAFT, "draft", draft))

    def _taken_up(self, file: str, what: str, take_up: Callable[[Path], None]) -> tuple[str, ...]:
        path = self._folder / file
        if not path.exists():
            return ()
        try:
            take_up(path)
        except (RisoriusError, OSError, ValueError) as error:
            aside = path.with_name(f"{path.stem}-broken.json")
            path.replace(aside)
            return (f"the saved {what} cannot be opened and was renamed to {aside.name}: {error}",)
        return ()

    def _read(self, path: Path, files: SessionFiles) -> tuple[Opened, int]:
        saved = parsed(path.read_bytes(), FILE).read(AutosaveDocument)
        score = self._folder / Path(saved.score).name
        sound = None if saved.sound is None else self._folder / Path(saved.sound).name
        score_file = _with_own_sound(read_score(parsed(score.read_bytes(), score.name), sound))
        version = version_of(saved.made, score_file, saved, files)
        return Opened(version, _view(saved.view)), saved.take


def _view(saved: Mapping[str, object]) -> PageView:
    """Return the saved view of the page, or a fresh one if it cannot be read: the session matters more."""
    try:
        return read_message(PageView, saved)
    except (RisoriusError, MisfitError):
        return PageView()


def _with_own_sound(score_file: ScoreFile) -> ScoreFile:
    """Return a score with a copy of its sound: that in the folder goes when another one is saved."""
    if score_file.utterance is None:
        return score_file
    audio = score_file.utterance.audio
    with AudioWriter(audio.sample_rate) as writer:
        for block in audio.blocks():
            writer.append(block)
        return ScoreFile(score_file.score, replace(score_file.utterance, audio=writer.finish()))
