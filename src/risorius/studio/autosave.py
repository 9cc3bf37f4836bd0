"""A session saved by itself: `project.json` after each change, the score and the sound beside it once."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

from ..core.audio import AudioWriter
from ..errors import RisoriusError
from ..ports.atomic import replacing
from ..ports.layout import write_json
from ..ports.node import Node
from ..ports.readable import ScoreFile
from ..ports.score_json import score_to_json
from .project import Opened, check_version, header, made_from, version_of, view_of
from .scores import parsed, score_file
from .session import Session
from .session_files import SessionFiles, digest, write_text
from .version import Version

FILE = "project.json"
_KEYS = ("risorius_project", "made", "edits", "view", "score", "sound", "take")


class Autosave:
    """Keeps a session's folder as the session is. `loaded` says once how the last one was found."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._base: object = None
        self._beside: dict[str, str | None] = {}

    def save(self, session: Session) -> None:
        """Save the present version, if there is one. Raises OutputError where the disk does not take it."""
        version = session.history.present
        if version is None:
            return
        if self._base is not version.base:
            self._beside = self._save_base(version)
            self._base = version.base
        document = {**header(version, session.view), **self._beside, "take": session.last_number}
        write_text(self._folder / FILE, json.dumps(document, ensure_ascii=False))
        self._tidy()

    def _save_base(self, version: Version) -> dict[str, str | None]:
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
        """Take up what was saved, if anything was; return what went wrong, then the file is put aside."""
        path = self._folder / FILE
        if not path.exists():
            return ()
        try:
            opened, number = self._read(path, session.files)
            session.restore(opened.version, opened.view, number)
        except (RisoriusError, OSError, ValueError) as error:
            aside = path.with_name("project-broken.json")
            path.replace(aside)
            return (f"what was saved cannot be opened and was put aside as {aside.name}: {error}",)
        return ()

    def _read(self, path: Path, files: SessionFiles) -> tuple[Opened, int]:
        entries = parsed(path.read_bytes()).entries(_KEYS, _KEYS[:-2])
        check_version(entries["risorius_project"])
        score = parsed(self._named(entries["score"]).read_bytes())
        named = entries.get("sound")
        sound = None if named is None or named.value is None else self._named(named)
        held = _with_own_sound(score_file(score, sound))
        version = version_of(made_from(entries["made"]), held, entries, files)
        return Opened(version, view_of(entries)), entries["take"].integer() if "take" in entries else 0

    def _named(self, node: Node) -> Path:
        return self._folder / Path(node.text()).name


def _with_own_sound(held: ScoreFile) -> ScoreFile:
    """Return a score with a copy of its sound: that in the folder goes when another one is saved."""
    if held.utterance is None:
        return held
    audio = held.utterance.audio
    with AudioWriter(audio.sample_rate) as writer:
        for block in audio.blocks():
            writer.append(block)
        return ScoreFile(held.score, replace(held.utterance, audio=writer.finish()))
