"""A session with the pages that show it and the thread that does its work."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Protocol, TypeVar

from ..core.edits import Edit
from ..errors import OutputError, RisoriusError
from ..take import Take
from .project import exports
from .project.autosave import Autosave
from .project.exports import Exports
from .project.project import open_project, project_file
from .session.session import Session
from .wire import answers, events, requests, takes

T = TypeVar("T")


class Page(Protocol):
    """A page that shows a session. `tell` must return at once."""

    def tell(self, event: Any) -> None:
        """Queue an event for the page."""


class SharedSession:
    """A session and the pages that show it."""

    def __init__(self, name: str, folder: Path) -> None:
        self.session = Session(name, folder)
        self.exports = Exports(folder)
        self.pages: set[Page] = set()
        self._autosave = Autosave(folder)
        self._loaded = False
        self._tasks: set[asyncio.Task[Any]] = set()
        self._exporting: set[asyncio.Task[Any]] = set()
        self._worker = ThreadPoolExecutor(1, thread_name_prefix=f"session-{name}")
        self._exporter = ThreadPoolExecutor(1, thread_name_prefix=f"export-{name}")

    async def handle(self, work: Callable[[Session], T], page: Page, *, changes: bool, saves: bool) -> T:
        """Return what a page's `work` on the session returns; then tell other pages, and save, if it must be.

        Work that has begun is finished and saved even if the page closes meanwhile.
        """
        task = asyncio.get_running_loop().create_task(self._answer(work, page, changes, saves))
        self._hold(task, self._tasks)
        return await asyncio.shield(task)

    async def _answer(self, work: Callable[[Session], T], page: Page, changes: bool, saves: bool) -> T:
        answer = await self._run(lambda: work(self.session))
        if changes:
            await self.tell_others(page)
        if saves:
            # The page does not wait for the disk: an event tells it when the session is saved.
            self._hold(asyncio.get_running_loop().create_task(self.save()), self._tasks)
        return answer

    async def preview(self, *edits: Edit) -> tuple[Take, takes.Previewed]:
        """Return the take that edits would make, and the answer for the page."""
        return await self._run(lambda: self.session.preview(*edits))

    async def save(self) -> None:
        """Save the session; tell its pages that it is saved, or why it is not."""
        try:
            await self._run(lambda: self._autosave.save(self.session))
        except OutputError as error:
            await self.tell(events.Saved(str(error)))
        else:
            await self.tell(events.Saved())

    async def project(self) -> bytes:
        """Return the project as a file."""
        return await self._run(lambda: project_file(self.session))

    async def open_project(self, data: bytes) -> None:
        """Go on with an uploaded project, which can be undone; on RisoriusError nothing changes."""

        def opened() -> None:
            project = open_project(data, self.session.files)
            self.session.open_version(project.version, project.view)

        await self._run(opened)
        await self.tell_others(None)
        await self.save()

    async def alone(self, work: Callable[[], T]) -> T:
        """Do work on the session's folder after all that was begun is saved."""
        await self.save()
        return await self._run(work)

    async def add_recording(self, name: str, uploaded: Path) -> str:
        """Save an uploaded recording; return the name that it was given."""
        return await self._run(lambda: self.session.files.add_recording(name, uploaded))

    def export(self, request: requests.Export) -> answers.Job:
        """Begin an export; the pages are told its progress. Raises RisoriusError if it cannot be made."""
        take = self.session.live(request.take).take
        exports.check(take, request)
        job = self.exports.begin()
        loop = asyncio.get_running_loop()

        def report(stage: str, done: int = 0, total: int = 0) -> None:
            event = events.ProgressEvent(stage, done, total, job=job)
            asyncio.run_coroutine_threadsafe(self.tell(event), loop)

        def write() -> events.Exported:
            try:
                names = self.exports.write(job, take, request, report)
            except RisoriusError as error:
                return events.Exported(job, (), str(error))
            path = f"/api/session/{self.session.name}/export/{job}/"
            return events.Exported(job, tuple(answers.Download(path + name, name) for name in names))

        async def run() -> None:
            await self.tell(await loop.run_in_executor(self._exporter, write))

        self._hold(loop.create_task(run()), self._exporting)
        return answers.Job(job)

    async def tell(self, event: Any) -> None:
        """Send an event to all pages; a page that reads slowly does not delay the others."""
        for page in tuple(self.pages):
            page.tell(event)

    async def tell_others(self, page: Page | None) -> None:
        """Tell all pages but `page` that the session has a new take."""
        current = self.session.current
        for other in self.pages - {page}:
            other.tell(events.Changed(0 if current is None else current.number))

    async def finish(self) -> None:
        """Finish and save the work that pages asked for, then close; running exports are dropped."""
        while self._tasks:
            await asyncio.wait(self._tasks)
        self.close()

    def close(self) -> None:
        """Release the threads."""
        self._worker.shutdown(wait=False, cancel_futures=True)
        self._exporter.shutdown(wait=False, cancel_futures=True)

    async def _run(self, work: Callable[[], T]) -> T:
        """Run `work` on the session's thread; the first call loads the session from its folder."""

        def loaded() -> T:
            if not self._loaded:
                self.session.notes = self._autosave.load(self.session)
                self._loaded = True
            return work()

        return await asyncio.get_running_loop().run_in_executor(self._worker, loaded)

    def _hold(self, task: asyncio.Task[Any], tasks: set[asyncio.Task[Any]]) -> None:
        tasks.add(task)

        def forget(task: asyncio.Task[Any]) -> None:
            tasks.discard(task)
            if not task.cancelled():
                # If the page has closed, nobody else reads the exception, and asyncio would log it.
                task.exception()

        task.add_done_callback(forget)
