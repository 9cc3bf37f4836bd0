"""The journal of a batch: one line of JSON for each line that is whole, safe on disk before the next.

A journal ends anywhere when the program is killed: a torn last line is dropped. Journals of shards stand
beside each other, and each run reads them all.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import IO

from ..errors import InputError, OutputError, Place
from ..machine.atomic import os_failure
from ..machine.file_lock import lock
from ..reading.json_text import parse_json
from .fingerprint import FileRecord
from .outcome import Outcome
from .scratch import Scratch

NAME = ".risorius-batch"
_SUFFIX, _LOCK = ".jsonl", ".risorius-batch.lock"


@dataclass(frozen=True, slots=True)
class JournalEntry:
    """A whole line: its id, its fingerprint, the records of its files, and its outcome."""

    id: str
    digest: str
    files: Mapping[str, FileRecord] = field(default_factory=dict)
    outcome: Outcome = field(default_factory=Outcome)

    def text(self) -> str:
        """Return the entry as a line of JSON."""
        return json.dumps(asdict(self), ensure_ascii=False, separators=(",", ":")) + "\n"

    @classmethod
    def read(cls, text: str) -> JournalEntry | None:
        """Return the entry in a line of JSON; None if it cannot be read, for example a torn line."""
        try:
            return parse_json(text, NAME).read(cls)
        except InputError:
            return None


class Journal(Scratch):
    """The journals of a folder: all are read; that of `shard` ("2-of-8"; empty for one alone) is written.

    Raises OutputError if another run has it, or if it cannot be written.
    """

    def __init__(self, folder: Path, shard: str = "") -> None:
        self.folder, self.path = folder, folder / f"{NAME}{shard and '-'}{shard}{_SUFFIX}"
        self._lock: IO[bytes] | None = None
        self._file: IO[bytes] | None = None
        super().__init__("entries (id TEXT PRIMARY KEY, entry TEXT) WITHOUT ROWID")
        try:
            folder.mkdir(parents=True, exist_ok=True)
            # One run of all lines, or several of shards; never two of one shard.
            self._lock = _locked(folder / _LOCK, shared=bool(shard))
            self._file = _locked(self.path)
            _drop_torn_line(self._file)
            self._read()
        except OSError as error:
            self.close()
            raise os_failure(self.path, error) from error
        except BaseException:
            self.close()
            raise

    def entry(self, name: str) -> JournalEntry | None:
        """Return the latest entry of an id, None if it has no entry."""
        row = self._database.execute("SELECT entry FROM entries WHERE id = ?", (name,)).fetchone()
        return None if row is None else JournalEntry.read(row[0])

    def append(self, entry: JournalEntry) -> None:
        """Add an entry; it is on disk when this returns. Raises OutputError."""
        assert self._file is not None
        text = entry.text()
        try:
            self._file.write(text.encode())
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            raise os_failure(self.path, error) from error
        self._database.execute("INSERT OR REPLACE INTO entries VALUES (?, ?)", (entry.id, text))

    def close(self) -> None:
        """Release the journal."""
        for file in (self._file, self._lock):
            if file is not None:
                file.close()
        super().close()

    def _read(self) -> None:
        others = [path for path in self.folder.glob(f"{NAME}*{_SUFFIX}") if path != self.path]
        for path in (*sorted(others), self.path):
            with path.open("rb") as file:
                self._database.executemany("INSERT OR REPLACE INTO entries VALUES (?, ?)", _ids(file))


def _ids(lines: IO[bytes]) -> Iterator[tuple[str, str]]:
    for line in lines:
        text = line.decode("utf-8", "replace")
        entry = JournalEntry.read(text)
        if entry is not None:
            yield entry.id, text


def _locked(path: Path, *, shared: bool = False) -> IO[bytes]:
    """Open a file to read and to append to it, and lock it until it is closed or this process ends."""
    file = path.open("a+b")
    try:
        lock(file, shared=shared)
    except BlockingIOError:
        file.close()
        raise OutputError(
            "another batch is running in this folder; wait for it or choose another folder", Place(str(path))
        ) from None
    return file


def _drop_torn_line(file: IO[bytes]) -> None:
    end = file.seek(0, os.SEEK_END)
    if not end:
        return
    start = max(0, end - 1)
    while start >= 0:
        start = max(0, start - 65_536)
        file.seek(start)
        last = file.read(end - start).rfind(b"\n")
        if last >= 0 or start == 0:
            file.truncate(start + last + 1)
            return
