"""Requests that a page's own connection answers: faces, previews, what runs and exports."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager

from ..core.edits import Edit
from .faces.pose_preview import PosePreview
from .faces.solvers import Solvers
from .faces.streaming import Send, Streams
from .shared_session import SharedSession
from .wire import answers, requests, takes


class PageRequests:
    """Answers a page's requests that concern this page alone, each by the method of its name.

    `number` is that of the request.
    """

    def __init__(self, shared: SharedSession, threads: Executor, solvers: Solvers, send: Send) -> None:
        self._shared = shared
        self._streams = Streams(threads, solvers, send)
        self._poses = PosePreview(threads, solvers, send)
        self._running: dict[int, threading.Event] = {}

    @contextmanager
    def running(self, number: int) -> Iterator[threading.Event]:
        """Yield the event that is set if the page stops a request while the block runs."""
        stopped = self._running[number] = threading.Event()
        try:
            yield stopped
        finally:
            self._running.pop(number, None)

    async def close(self) -> None:
        """Stop what is sent of a pose."""
        await self._poses.stop()

    async def faces(self, number: int, request: requests.Faces) -> answers.FacesSent:
        """Send the faces of some frames."""
        return await self._streams.send(self._shared.session.live(request.take), request)

    async def face_at(self, number: int, request: requests.FaceAt) -> answers.FacesSent:
        """Send the face at a time."""
        return await self._streams.moment(self._shared.session.live(request.take), request)

    async def cancel(self, number: int, request: requests.Cancel) -> answers.Done:
        """Stop sending a take's faces."""
        self._streams.cancel(request.take)
        return answers.Done()

    async def preview(self, number: int, request: requests.Preview) -> takes.Previewed:
        """Return the effect of an edit."""
        return await self._previewed((request.edit,), request.face)

    async def preview_all(self, number: int, request: requests.PreviewAll) -> takes.Previewed:
        """Return the effect of several edits as one change."""
        return await self._previewed(request.edits, request.face)

    async def _previewed(self, edits: tuple[Edit, ...], face: float | None) -> takes.Previewed:
        take, previewed = await self._shared.preview(*edits)
        if face is not None:
            await self._streams.held(take, previewed.take, face)
        return previewed

    async def dial(self, number: int, request: requests.Dial) -> answers.DialState:
        """Show a pose."""
        return await self._poses.turn(number, request, self._shared.session.files)

    async def stop(self, number: int, request: requests.Stop) -> answers.Done:
        """Stop a request of this page."""
        if request.request in self._running:
            self._running[request.request].set()
        return answers.Done()

    async def export(self, number: int, request: requests.Export) -> answers.Job:
        """Begin an export."""
        return self._shared.export(request)

    async def cancel_export(self, number: int, request: requests.CancelExport) -> answers.Done:
        """Stop an export."""
        self._shared.exports.stop(request.job)
        return answers.Done()

    async def project(self, number: int, request: requests.Project) -> answers.Download:
        """Return the address of the project file."""
        path = f"/api/session/{self._shared.session.name}/project"
        return answers.Download(path, "performance.risorius.json")
