"""The functions that programs call: `batch` over rows or a manifest, `pipe` over texts."""

from __future__ import annotations

import os
import sys
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from ..api import Emotions, checked, displays_of
from ..errors import InputError, OutputError, Place, RisoriusError
from ..settings import Settings
from .executors import BatchExecutor, InProcess, LocalPool
from .jobs import JobMaker
from .journal import Journal
from .manifest import Manifest, ManifestRow, cells_of
from .outcome import LineResult
from .patterns import OutputPattern
from .places import is_remote
from .report import Report
from .run import WHOLE, BatchRun, Shard, name_of_run
from .texts import takes

if TYPE_CHECKING:
    from ..take import Take

BatchRows = str | PathLike[str] | Iterable[Mapping[str, object]]
C = TypeVar("C")
SECONDS = 600.0
"""The time limit of a line."""


@dataclass(frozen=True)
class BatchPlan:
    """All that is decided before the first line: rows, outputs, settings for all, and the executor.

    `processes` 0: this process alone. `ray`: the address of a cluster, None for none. `journal`: the folder
    of journal and report, None for the fixed folder of the first output. `sheets`: pictures for the report.
    Raises RisoriusError for what concerns all lines.
    """

    rows: BatchRows
    outputs: Sequence[str]
    settings: Settings
    emotions: Emotions = ()
    processes: int = 1
    seconds: float = SECONDS
    ray: str | None = None
    shard: Shard = WHOLE
    journal: Path | None = None
    ignore: Sequence[str] = ()
    sheets: bool = False

    @property
    def manifest(self) -> Manifest | None:
        """The manifest, None for rows that a program has."""
        return Manifest(Path(self.rows)) if isinstance(self.rows, str | PathLike) else None

    def read(self) -> Iterator[ManifestRow | RisoriusError]:
        """Yield the rows, anew each time if they come from a manifest."""
        if isinstance(self.rows, str | PathLike):
            return Manifest(Path(self.rows)).rows()
        return _rows_of(self.rows)

    def maker(self) -> JobMaker:
        """Return the maker of jobs from rows."""
        if not self.outputs:
            raise OutputError("no output named; expected e.g. -o 'out/{id}.arkit.csv'")
        patterns = [OutputPattern(os.fspath(output)) for output in self.outputs]
        manifest = self.manifest
        folder = Path() if manifest is None else manifest.folder
        displays = displays_of(self.emotions, self.settings)
        sheets = self.folder() / "sheets" if self.sheets else None
        return JobMaker(patterns, folder, self.settings, displays, self.ignore, sheets)

    def folder(self) -> Path:
        """Return the folder of journal and report; raises OutputError if none is here or named."""
        if self.journal is not None:
            return self.journal
        fixed = OutputPattern(os.fspath(self.outputs[0])).fixed_folder
        if is_remote(fixed + "/"):
            raise OutputError(
                "a journal needs a folder here; expected --journal FOLDER", Place(self.outputs[0])
            )
        return Path(fixed)

    def executor(self, run: str) -> BatchExecutor:
        """Return the executor of the lines."""
        if self.ray is not None:
            from .ray_cluster import RayCluster

            return RayCluster(self.ray, max(1, self.processes), self.seconds, run)
        return LocalPool(self.processes, self.seconds, run) if self.processes else InProcess(run)

    def run(self) -> Generator[LineResult]:
        """Perform the lines, yielding results as they come; at the end the report is written."""
        maker, folder = self.maker(), self.folder()
        with ExitStack() as stack:
            journal = stack.enter_context(Journal(folder, self.shard.name))
            report = stack.enter_context(Report(folder, self.shard.name))
            executor = self.executor(name_of_run(journal))
            for result in BatchRun(self.read(), maker, journal, executor, self.shard).lines():
                report.add(result)
                yield result
            report.write()


def batch(
    rows: BatchRows,
    outputs: str | Sequence[str],
    *,
    settings: Settings | None = None,
    emotion: Emotions = (),
    jobs: int | None = None,
    timeout: float = SECONDS,
    ray: str | None = None,
    shard: str | None = None,
    journal: str | PathLike[str] | None = None,
    ignore: Sequence[str] = (),
    sheets: bool = False,
) -> Iterator[LineResult]:
    """Perform many lines into files, and yield the result of each as it comes, in any order.

    `rows`: mappings with an `id` and a `text`, a `script` or an `audio` with its `transcript`, and settings
    by name; or the name of a manifest. `outputs`: patterns such as "out/{id}.arkit.csv". Lines complete from
    an earlier run is not made again. `jobs`: processes, by default one a core, 0 for this one alone;
    `timeout`: seconds that a line may take; `ray`: the address of a Ray cluster; `shard`: "3/8" for the third
    of eight runs; `journal`: the folder of journal and report; `ignore`: columns that nothing reads;
    `sheets`: pictures for the report.

    A line that fails is a result with its `error`. Raises RisoriusError for what concerns all lines.
    """
    _check_iterable("rows", rows)
    _check_iterable("outputs", outputs)
    names = (outputs,) if isinstance(outputs, str) else tuple(outputs)
    if jobs is not None and (not isinstance(jobs, int) or jobs < 0):
        raise InputError(f"jobs = {jobs!r}; expected a whole number, 0 or more")
    if not isinstance(timeout, int | float) or not timeout > 0.0:
        raise InputError(f"timeout = {timeout!r}; expected seconds, more than 0")
    processes = usual_processes() if jobs is None else jobs
    part = Shard() if shard is None else Shard.parse(shard)
    folder = None if journal is None else Path(journal)
    settings = checked(settings)
    plan = BatchPlan(
        rows,
        names,
        settings,
        displays_of(emotion, settings),
        processes,
        timeout,
        ray,
        part,
        folder,
        ignore,
        sheets,
    )
    plan.maker(), plan.folder()  # raise at once what is wrong with the arguments
    return plan.run()


def pipe(
    texts: Iterable[Any],
    *,
    n_process: int = 1,
    as_tuples: bool = False,
    emotion: Emotions = (),
    settings: Settings | None = None,
) -> Iterator[Any]:
    """Perform texts and yield their takes in the same order, by `n_process` processes.

    With `as_tuples` the texts are pairs of a text and anything, which comes back beside its take. Raises
    RisoriusError for the first text that cannot be performed.
    """
    _check_iterable("texts", texts)
    settings = checked(settings)
    displays = displays_of(emotion, settings)
    if not as_tuples:
        return takes(texts, displays, settings, n_process)
    return _with_contexts(texts, displays, settings, n_process)


def usual_processes() -> int:
    """Return how many processes perform lines: one a core; none beside this one on Windows, where
    workers have not been tried.
    """
    return 0 if sys.platform == "win32" else os.cpu_count() or 1


def _check_iterable(what: str, value: object) -> None:
    if not isinstance(value, Iterable | PathLike):
        raise InputError(f"{what} are {type(value).__name__}; expected a sequence")


def _with_contexts(
    pairs: Iterable[tuple[str, C]], displays: Any, settings: Settings, processes: int
) -> Iterator[tuple[Take, C]]:
    contexts: list[C] = []

    def texts() -> Iterator[str]:
        for pair in pairs:
            if not isinstance(pair, tuple | list) or len(pair) != 2:
                raise InputError(f"{type(pair).__name__} is not a pair; expected a text and its context")
            text, context = pair
            contexts.append(context)
            yield text

    for take in takes(texts(), displays, settings, processes):
        yield take, contexts.pop(0)


def _rows_of(rows: Iterable[Mapping[str, object]]) -> Iterator[ManifestRow | RisoriusError]:
    for number, row in enumerate(rows, 1):
        place = Place("row", number)
        try:
            yield ManifestRow(place, cells_of(row))
        except InputError as error:
            yield error.at(place)
