"""A run of a batch: rows become jobs; complete lines are left alone, the others performed and journalled."""

from __future__ import annotations

import json
import re
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO

from ..errors import DiskFullError, InputError, Place, RisoriusError
from ..machine.atomic import os_failure, remove_temporaries
from .executors import BatchExecutor
from .fingerprint import FileRecord, fingerprint
from .jobs import BatchJob, JobMaker, at_row, check_job
from .journal import Journal, JournalEntry
from .manifest import ManifestRow
from .outcome import LineResult, LineState, Outcome
from .places import is_remote, size_of
from .scratch import Scratch

ERRORS = "errors"


@dataclass(frozen=True, slots=True)
class Shard:
    """The lines that one of `count` runs makes: those whose ids fall to `number`, 1 to `count`."""

    number: int = 1
    count: int = 1

    @classmethod
    def parse(cls, text: str) -> Shard:
        """Return the shard of a text such as "3/8"; raise InputError for any other text."""
        match = re.fullmatch(r"(\d{1,6})/(\d{1,6})", text.strip())
        if match is None or not 1 <= int(match[1]) <= int(match[2]):
            raise InputError(f"'{text[:40]}' is not a shard; expected e.g. 3/8: the third of eight")
        return cls(int(match[1]), int(match[2]))

    @property
    def name(self) -> str:
        """Its name in those of files; empty if there is but one."""
        return f"{self.number}-of-{self.count}" if self.count > 1 else ""

    def holds(self, name: str) -> bool:
        """Whether a line's id falls to it: by a checksum, so that other lines do not matter."""
        return zlib.crc32(name.encode("utf-8", "surrogatepass")) % self.count == self.number - 1


WHOLE = Shard()
"""All lines."""


@dataclass
class BatchRun:
    """A run over the rows of a manifest. `lines()` yields the outcome of each, in any order."""

    rows: Iterable[ManifestRow | RisoriusError]
    maker: JobMaker
    journal: Journal
    executor: BatchExecutor
    shard: Shard = WHOLE
    _pending: dict[str, tuple[str, dict[str, FileRecord]]] = field(default_factory=dict, init=False)
    _folders: set[Path] = field(default_factory=set, init=False)

    @property
    def errors_path(self) -> Path:
        """The file of the lines that failed."""
        return self.journal.folder / f"{ERRORS}{self.shard.name and '-'}{self.shard.name}.jsonl"

    def lines(self) -> Iterator[LineResult]:
        """Perform incomplete lines; yield the result of every row. Raises DiskFullError."""
        try:
            with self.errors_path.open("w", encoding="utf-8") as errors:
                for result in self._lines():
                    if result.error:
                        _write_error(errors, result)
                    yield result
        except OSError as error:
            raise os_failure(self.errors_path, error) from error
        finally:
            self.executor.close()
            for folder in self._folders:
                remove_temporaries(folder, self.run_name)

    def _lines(self) -> Iterator[LineResult]:
        with _Names() as names:
            for number, row in enumerate(self.rows):
                if not self.shard.holds(_name_of(row, number)):
                    continue
                job_or_result = self._known(row, names)
                if isinstance(job_or_result, LineResult):
                    yield job_or_result
                else:
                    yield from self._made(block=False)
                    while self.executor.full:
                        yield from self._made(block=True)
                    self.executor.submit(job_or_result)
        self.executor.flush()
        while self.executor.busy:
            yield from self._made(block=True)

    def _known(self, row: ManifestRow | RisoriusError, names: _Names) -> LineResult | BatchJob:
        """Return the job of a row, or its result if it is whole or cannot be performed."""
        job: BatchJob | None = None
        try:
            if isinstance(row, RisoriusError):
                raise row
            job = self.maker.job(row)
            with at_row(job.place):
                names.add(job)
                entry = self.journal.entry(job.id)
                digest, files = fingerprint(job, entry.files if entry else {})
        except RisoriusError as error:
            name = job.id if job else row.cells.get("id", "") if isinstance(row, ManifestRow) else ""
            return _failed(name, error)
        if entry is not None and entry.digest == digest and _is_whole(entry):
            return LineResult(job.id, job.place, LineState.WHOLE, entry.outcome)
        self._pending[job.id] = digest, files
        for name in (*job.outputs, *filter(None, (job.sheet,))):
            self._clear(name)
        return job

    def _clear(self, output: str) -> None:
        """Remove the files that a killed run left beside an output, once for each folder."""
        folder = Path(output).parent
        if not is_remote(output) and folder not in self._folders:
            self._folders.add(folder)
            remove_temporaries(folder, self.run_name)

    @property
    def run_name(self) -> str:
        """The name of this run in those of temporary files, the same when it is started again."""
        return name_of_run(self.journal)

    def _made(self, *, block: bool) -> Iterator[LineResult]:
        for job, outcome in self.executor.results(block=block):
            digest, files = self._pending.pop(job.id)
            if outcome.stops:
                raise DiskFullError(f"{outcome.error}; free some, and start again to go on")
            if outcome.error:
                yield LineResult(job.id, job.place, LineState.FAILED, outcome)
            else:
                self.journal.append(JournalEntry(job.id, digest, files, outcome))
                yield LineResult(job.id, job.place, LineState.MADE, outcome)


def name_of_run(journal: Journal) -> str:
    """Return the name in temporary files of the runs that keep a journal."""
    return f"batch-{zlib.crc32(str(journal.path.resolve()).encode()):08x}"


def check_rows(
    rows: Iterable[ManifestRow | RisoriusError], maker: JobMaker, shard: Shard, *, scripts: bool = True
) -> Iterator[RisoriusError | None]:
    """Yield for each row the error that it would fail with, as far as that shows beforehand, or None."""
    with _Names() as names:
        for number, row in enumerate(rows):
            if shard.holds(_name_of(row, number)):
                try:
                    if isinstance(row, RisoriusError):
                        raise row
                    job = maker.job(row)
                    with at_row(job.place):
                        names.add(job)
                    if scripts:
                        check_job(job)
                except RisoriusError as error:
                    yield error
                else:
                    yield None


def _name_of(row: ManifestRow | RisoriusError, number: int) -> str:
    return row.cells.get("id", str(number)).strip() if isinstance(row, ManifestRow) else str(number)


def _failed(name: str, error: RisoriusError) -> LineResult:
    return LineResult(name, error.place or Place("manifest"), LineState.FAILED, Outcome(error=error.message))


def _is_whole(entry: JournalEntry) -> bool:
    return all(size_of(name) == size for name, size in entry.outcome.outputs.items())


def _write_error(errors: IO[str], result: LineResult) -> None:
    line = {"id": result.id, "file": result.place.file, "line": result.place.line, "error": result.error}
    errors.write(json.dumps(line, ensure_ascii=False) + "\n")
    errors.flush()


class _Names(Scratch):
    """The ids and outputs so far, on disk if they are many."""

    def __init__(self) -> None:
        super().__init__("names (name TEXT PRIMARY KEY, place TEXT) WITHOUT ROWID")

    def add(self, job: BatchJob) -> None:
        """Take in a job; raises InputError if its id, or one of its outputs, is another row's."""
        for what, name in (("id", job.id), *(("output", output) for output in job.outputs)):
            row = (f"{what} {name}", str(job.place))
            before = self._database.execute("SELECT place FROM names WHERE name = ?", row[:1]).fetchone()
            if before is not None:
                raise InputError(f"the {what} '{name}' is also used by {before[0]}; expected a different one")
            self._database.execute("INSERT INTO names VALUES (?, ?)", row)
