"""A session with the pages that show it, the thread that works for it, and what is done after each change."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Protocol, TypeVar

from ..core.progress import Progress
from ..errors import OutputError, RisoriusError
from ..take import Take
from . import exports, looking, wire
from .autosave import Autosave
from .exports import Exports
from .project import open_project, project_file
from .session import Session

T = TypeVar("T")
Handler = Callable[[Session, Any, Progress], Any]

HANDLERS: dict[type, Handler] = {
    wire.Open: Session.open,
    wire.Perform: Session.perform,
    wire.Prepare: Session.prepare,
    wire.Choose: Session.choose,
    wire.Compare: Session.compare,
    **dict.fromkeys(wire.EDITS.values(), Session.edit),
    wire.Undo: Session.undo,
    wire.Redo: Session.redo,
    wire.View: Session.keep_view,
    wire.Explain: looking.explain,
    wire.ChannelCurves: looking.channel_curves,
    wire.RulesFired: looking.rules_fired,
    wire.ProfileText: looking.profile_save,
    wire.SavePose: looking.name_pose,
}
"""What is done on the session's thread, by request."""
CHANGING = (wire.Perform, wire.Choose, *wire.EDITS.values(), wire.Undo, wire.Redo)
SAVING = (*CHANGING, wire.View)


class Page(Protocol):
    """What shows a session: told of what happens, it must not wait."""

    def tell(self, told: Any) -> None:
        """Take up an event."""


class Room:
    """A session with its pages."""

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

    async def done(self, asked: Any, progress: Progress, page: Page) -> Any:
        """Return the answer to a request of a page; save and tell other pages what it changes.

        What is begun is done and saved even if the page goes meanwhile.
        """
        task = asyncio.get_running_loop().create_task(self._do(asked, progress, page))
        self._keep(task, self._tasks)
        return await asyncio.shield(task)

    async def _do(self, asked: Any, progress: Progress, page: Page) -> Any:
        answered = await self._run(lambda: HANDLERS[type(asked)](self.session, asked, progress))
        if isinstance(asked, CHANGING):
            await self.tell_others(page)
        if isinstance(asked, SAVING):
            # The page need not wait for the disk: it hears of it when it is done.
            self._keep(asyncio.get_running_loop().create_task(self.save()), self._tasks)
        return answered

    async def preview(self, edit: wire.Edit) -> tuple[Take, wire.Previewed]:
        """Return the take that an edit would make, and what the page is told of it."""
        return await self._run(lambda: self.session.preview(edit))

    async def save(self) -> None:
        """Save the session; tell its pages that it is, or why it is not."""
        try:
            await self._run(lambda: self._autosave.save(self.session))
        except OutputError as error:
            await self.tell(wire.Saved(str(error)))
        else:
            await self.tell(wire.Saved())

    async def project(self) -> bytes:
        """Return the project as a file."""
        return await self._run(lambda: project_file(self.session))

    async def take_up(self, data: bytes) -> None:
        """Take up an uploaded project in place of the session's own; raise RisoriusError, then nothing is."""

        def opened() -> None:
            found = open_project(data, self.session.shelf)
            self.session.restore(found.version, found.view)

        await self._run(opened)
        await self.tell_others(None)
        await self.save()

    async def take_in(self, name: str, uploaded: Path) -> str:
        """Keep an uploaded recording; return the name it has got."""
        return await self._run(lambda: self.session.shelf.take_in(name, uploaded))

    def export(self, asked: wire.Export) -> wire.Job:
        """Begin an export; its pages hear how far it is. Raises RisoriusError where it cannot be made."""
        take = self.session.live(asked.take).take
        exports.check(take, asked)
        job = self.exports.begin()
        loop = asyncio.get_running_loop()

        def told(stage: str, done: int = 0, total: int = 0) -> None:
            event = wire.Progress(stage, done, total, job=job)
            asyncio.run_coroutine_threadsafe(self.tell(event), loop)

        def written() -> wire.Exported:
            try:
                names = self.exports.write(job, take, asked, told)
            except RisoriusError as error:
                return wire.Exported(job, (), str(error))
            path = f"/api/session/{self.session.name}/export/{job}/"
            return wire.Exported(job, tuple(wire.Download(path + name, name) for name in names))

        async def run() -> None:
            await self.tell(await loop.run_in_executor(self._exporter, written))

        self._keep(loop.create_task(run()), self._exporting)
        return wire.Job(job)

    async def tell(self, event: Any) -> None:
        """Send an event to all pages; one that is slow to read holds up nobody else."""
        for page in tuple(self.pages):
            page.tell(event)

    async def tell_others(self, page: Page | None) -> None:
        """Tell all other pages that the session's take is another."""
        current = self.session.current
        for other in self.pages - {page}:
            other.tell(wire.Changed(0 if current is None else current.number))

    async def finish(self) -> None:
        """Close, what pages have asked for being done and saved; exports under way are given up."""
        while self._tasks:
            await asyncio.wait(self._tasks)
        self.close()

    def close(self) -> None:
        """Let the threads go."""
        self._worker.shutdown(wait=False, cancel_futures=True)
        self._exporter.shutdown(wait=False, cancel_futures=True)

    async def _run(self, work: Callable[[], T]) -> T:
        """Do work on the session's thread, where it is taken up from its folder first."""

        def loaded() -> T:
            if not self._loaded:
                self.session.notes = self._autosave.load(self.session)
                self._loaded = True
            return work()

        return await asyncio.get_running_loop().run_in_executor(self._worker, loaded)

    def _keep(self, task: asyncio.Task[Any], among: set[asyncio.Task[Any]]) -> None:
        among.add(task)

        def forget(task: asyncio.Task[Any]) -> None:
            among.discard(task)
            if not task.cancelled():
                # Where a page has gone nobody else asks for it, and asyncio would complain.
                task.exception()

        task.add_done_callback(forget)
