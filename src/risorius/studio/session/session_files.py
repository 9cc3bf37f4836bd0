"""Recordings, poses and emotions of a session, saved in its folder under the names that the page sends.

A name is looked up in the list of files that exist; no path is ever built from it.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TypeVar

from ...core.action_units import resolve_targets
from ...errors import InputError, RisoriusError, unknown
from ...machine.atomic import replacing
from ...reading.json_text import load_json
from ...rules.emotions import emotion, emotion_key, emotion_names, emotion_text
from ...script.suffixes import RECORDING_SUFFIXES
from ...speech.recordings.recording import read_recording
from ..uploads import BEGINNING

T = TypeVar("T")
_NAME = re.compile(r"[\w][\w -]{0,59}")
_MOST = 200


class SessionFiles:
    """The recordings, poses and emotions in a session's folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._emotions = _table(folder / "emotions.json", dict[str, str])
        self._poses = _table(folder / "poses.json", dict[str, dict[str, float]])

    def told(self, text: str) -> str:
        """Return a line for the page: files of the session by the names that the user gave them."""
        here = re.escape(str(self.folder))
        text = re.sub(rf"{here}/recordings/([\w-]+)-[0-9a-f]{{8}}(\.\w+)", r"\1\2", text)
        return re.sub(rf"{here}/(?:recordings/)?", "", text)

    def recordings(self) -> tuple[str, ...]:
        """Return the names of the recordings, in alphabetical order."""
        folder = self.folder / "recordings"
        return tuple(sorted(p.name for p in folder.iterdir())) if folder.is_dir() else ()

    def recording(self, name: str) -> Path:
        """Return a recording's file; raise InputError with the nearest name if it does not exist."""
        if name not in self.recordings():
            raise InputError(unknown("recording", name, self.recordings()))
        return self.folder / "recordings" / name

    def add_recording(self, name: str, uploaded: Path) -> str:
        """Save an uploaded recording and return its new name; raise InputError if it cannot be read."""
        stem, suffix = Path(name).stem, Path(name).suffix.lower()
        if suffix not in RECORDING_SUFFIXES:
            raise InputError(f"'{name}' is not a recording; expected {', '.join(RECORDING_SUFFIXES)}")
        try:
            read_recording(uploaded)
        except InputError as error:
            raise InputError(f"the recording cannot be used: {error.message}") from None
        folder = self.folder / "recordings"
        folder.mkdir(exist_ok=True)
        if len(self.recordings()) >= _MOST:
            raise InputError(f"this session has {_MOST} recordings already; expected a new session")
        plain = re.sub(r"[^\w-]+", "-", stem, flags=re.ASCII).strip("-")[:40] or "recording"
        mark = digest(uploaded.read_bytes())[:8]
        saved_name = f"{plain.removesuffix(f'-{mark}')}-{mark}{suffix}"
        uploaded.replace(folder / saved_name)
        return saved_name

    def emotions(self) -> Mapping[str, str]:
        """Return the emotions that were saved: by name, the file of each."""
        return self._emotions

    def emotion_values(self) -> dict[str, dict[str, float]]:
        """Return the full display of each emotion that was saved, by name."""
        return {name: dict(emotion(self.emotion(name)).units) for name in self._emotions}

    def poses(self) -> Mapping[str, Mapping[str, float]]:
        """Return the poses that were saved, by name."""
        return self._poses

    def emotion(self, name: str) -> str:
        """Return the key by which the library finds an emotion: its name, or the file of a saved one."""
        if name in self._emotions:
            return str(self.folder / Path(self._emotions[name]).name)
        if name.strip().lower() not in emotion_names():
            raise InputError(unknown("emotion", name, (*self._emotions, *emotion_names())))
        return emotion_key(name)

    def temporary(self, data: bytes) -> Path:
        """Return a new file of the session's folder with `data`, to be taken in or removed."""
        number, name = tempfile.mkstemp(prefix=BEGINNING, dir=self.folder)
        with os.fdopen(number, "wb") as file:
            file.write(data)
        return Path(name)

    def save_emotion(self, name: str, values: Mapping[str, float]) -> str:
        """Save an emotion whose full display is `values`; return the text of its file."""
        self._check(name, self._emotions)
        if name.lower() in emotion_names():
            raise InputError(f"'{name}' is the name of an emotion of Risorius; expected another name")
        text = emotion_text(name, values)
        # Files are found by what is in them: the library keeps what it has read by its path.
        self._emotions[name] = kept_table(text, "emotion", self.folder).name
        write_text(self.folder / "emotions.json", json.dumps(self._emotions))
        return text

    def save_pose(self, name: str, values: Mapping[str, float]) -> None:
        """Save a pose: values by muscle, action unit or other parameter."""
        self._check(name, self._poses)
        resolve_targets(values)
        self._poses[name] = dict(values)
        write_text(self.folder / "poses.json", json.dumps(self._poses))

    def _check(self, name: str, saved: Mapping[str, object]) -> None:
        if not _NAME.fullmatch(name):
            raise InputError(f"'{name[:60]}' is not a name; expected up to 60 letters, digits, - and spaces")
        if name not in saved and len(saved) >= _MOST:
            raise InputError(f"{_MOST} are saved already; expected one of their names")


def write_text(path: Path, text: str) -> None:
    """Write a file whole or not at all."""
    with replacing(path) as beside:
        beside.write_text(text, encoding="utf-8")


def digest(data: bytes) -> str:
    """Return 16 hexadecimal digits that tell contents apart."""
    return hashlib.sha256(data).hexdigest()[:16]


def kept_table(text: str, kind: str, folder: Path) -> Path:
    """Write TOML under a name made from its content, unless it is there; return its path."""
    path = folder / f"{kind}-{digest(text.encode())}.toml"
    if not path.exists():
        write_text(path, text)
    return path


def _table(path: Path, cls: type[T]) -> T:
    """Return the object in a JSON file of ours; empty if the file is missing or damaged."""
    try:
        return load_json(path).read(cls)
    except RisoriusError:
        return cls()
