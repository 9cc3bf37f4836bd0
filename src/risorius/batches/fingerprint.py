"""A digest of all that a line is made from; it changes with input, settings, files and version."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import metadata
from pathlib import Path

from ..settings import Settings
from ..settings.declare import rows
from .jobs import BatchJob
from .places import is_remote, read_bytes, state_of

FileRecord = tuple[int, str, str]
"""Size in bytes, time of change, and digest of the content."""
_USED = ("risorius", "av", "espeakng-loader", "llvmlite", "numpy", "pocketsphinx", "scipy")
"""Packages on whose version the bytes of outputs depend."""


def fingerprint(job: BatchJob, records: Mapping[str, FileRecord]) -> tuple[str, dict[str, FileRecord]]:
    """Return the digest of a job, and the records of its files.

    A file is read unless its size and time of change are those of its `records` record.
    """
    files = {name: _record(name, records.get(name)) for name in files_of(job)}
    parts = [installation(), repr((job.given, job.emotions, job.settings, job.outputs, job.sheet))]
    parts += [f"{name} {record[2]}" for name, record in files.items()]
    return _digest("\n".join(parts).encode()), files


def files_of(job: BatchJob) -> list[str]:
    """Return the files that a line is made from: its input, and those that settings and emotions name."""
    source = job.given
    names = [str(source.audio)] if source.audio is not None else []
    names += [source.script] if source.script is not None and not source.text else []
    chosen = [source.transcript, *(display.emotion for display in job.emotions), *_texts(job.settings)]
    for text in filter(None, chosen):
        names += [text] if is_remote(text) else map(str, _files_named(text))
    return names


def _texts(settings: Settings) -> Iterator[str]:
    for name, row in rows(Settings).items():
        value = getattr(settings if row.owner == name else getattr(settings, row.owner), name)
        if isinstance(value, str | Path):
            yield str(value)


def _files_named(text: str) -> list[Path]:
    """Return the file of that name with those beside it whose names go on from it, or all of a folder."""
    path = Path(text)
    try:
        if path.is_dir():
            return sorted(file for file in path.rglob("*") if file.is_file())
        return sorted(path.parent.glob(f"{path.name}*")) if path.is_file() else []
    except (OSError, ValueError):
        return []  # no name of a file


def _record(name: str, record: FileRecord | None) -> FileRecord:
    size, changed = state_of(name) or (0, "")
    if record is not None and tuple(record[:2]) == (size, changed) and changed:
        return record
    return size, changed, _digest(read_bytes(name))


@cache
def installation() -> str:
    """Return the digest of our version and files, and of the versions of packages that change the bytes."""
    digest = hashlib.sha256(json.dumps([f"{name} {_version(name)}" for name in _USED]).encode())
    root = Path(__file__).parents[1]
    for path in sorted(root.rglob("*")):
        if path.is_file() and path.suffix != ".pyc":
            digest.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:32]


def _version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return ""


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:32]
