"""Exports: a take written to files in a session's folder, one after another, with progress."""

from __future__ import annotations

import re
import shutil
import threading
import zipfile
from collections import OrderedDict
from pathlib import Path

from ...core.look import TRANSPARENT, parse_colour
from ...core.progress import Progress
from ...errors import InputError
from ...machine.atomic import replacing
from ...ports.formats import FORMATS
from ...ports.output_files import check_targets
from ...settings import Settings, settings_of
from ...take import Take
from .. import limits
from ..stopping import stoppable
from ..wire import requests
from ..wire.choices import exported_rows

_NAME = re.compile(r"[^\w -]+")
_MOST_JOBS = 20
ARCHIVE = "all.zip"
"""Under this name all files of an export are one."""


class Exports:
    """The exports of a session. Files lie in `folder`/exports/NUMBER."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder / "exports"
        shutil.rmtree(self._folder, ignore_errors=True)
        self._jobs: OrderedDict[int, threading.Event] = OrderedDict()
        self._files: dict[tuple[int, str], Path] = {}
        self._last = 0

    def begin(self) -> int:
        """Return the number of a new export; the files of the oldest are deleted."""
        self._last += 1
        self._jobs[self._last] = threading.Event()
        while len(self._jobs) > _MOST_JOBS:
            oldest, _ = self._jobs.popitem(last=False)
            shutil.rmtree(self._folder / str(oldest), ignore_errors=True)
            self._files = {key: path for key, path in self._files.items() if key[0] != oldest}
        return self._last

    def stop(self, job: int) -> None:
        """Stop an export that runs or waits; its files are deleted."""
        if job not in self._jobs:
            raise InputError(f"there is no export {job}")
        self._jobs[job].set()

    def write(self, job: int, take: Take, request: requests.Export, progress: Progress) -> tuple[str, ...]:
        """Write the files and return their names. Raises RisoriusError; then nothing is kept."""
        stoppable_progress = stoppable(progress, self._jobs[job], "the export was stopped")
        folder = self._folder / str(job)
        folder.mkdir(parents=True, exist_ok=True)
        names = _names(request)
        stoppable_progress("Writing …")
        exported_take(take, request).write(*(folder / name for name in names), progress=stoppable_progress)
        self._files |= {(job, name): folder / name for name in names}
        return names

    def file(self, job: int, name: str) -> Path:
        """Return a file that an export has written; raise InputError for any other name."""
        if (job, name) not in self._files:
            raise InputError("there is no such file")
        return self._files[job, name]

    def archive(self, job: int) -> Path:
        """Return an archive of all files that an export has written; raise InputError for an unknown job."""
        files = [path for (number, _), path in self._files.items() if number == job]
        if not files:
            raise InputError("there is no such file")
        path = self._folder / str(job) / ARCHIVE
        if not path.exists():
            with replacing(path) as beside, zipfile.ZipFile(beside, "w", zipfile.ZIP_STORED) as archive:
                for file in files:
                    archive.write(file, file.name)
        return path


def check(take: Take, request: requests.Export) -> None:
    """Raise InputError or OutputError if an export is not possible."""
    if not 0 < len(request.suffixes) <= limits.EXPORTED:
        raise InputError(f"{len(request.suffixes)} files in one export; expected 1 to {limits.EXPORTED}")
    settings = _settings(take.settings, request)
    check_targets(_names(request), alpha=settings.look.transparent)


def exported_take(take: Take, request: requests.Export) -> Take:
    """Return a take with the look of an export."""
    return Take(take.performance, _settings(take.settings, request), take.utterance, take.sound, take.planned)


def _names(request: requests.Export) -> tuple[str, ...]:
    """Return the files' names: letters, digits, - and spaces of the name asked for, and each suffix."""
    stem = _NAME.sub("", request.name).strip()[:60] or "performance"
    return tuple(f"{stem}{FORMATS.get(suffix).suffix}" for suffix in request.suffixes)


def _settings(settings: Settings, request: requests.Export) -> Settings:
    values = {row.name: getattr(request, row.name) for row in exported_rows()}
    return settings_of({**values, "background": _background(request.background)}, settings)


def _background(background: str | None) -> str | None:
    """Return a background that is not a file."""
    if background not in (None, TRANSPARENT):
        return "#{:02x}{:02x}{:02x}".format(*parse_colour(background))
    return background
