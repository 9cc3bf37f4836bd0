"""The socket of a page: requests in, answers and faces out; a slow page delays only itself."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from ..errors import RisoriusError
from . import limits
from .decoding import BadRequestError, decode
from .faces.solvers import Solvers
from .page_requests import PageRequests
from .request_table import ROWS
from .shared_session import SharedSession
from .stopping import stoppable
from .wire import events
from .wire.messages import answer, event, refusal

OWN = 2  # tasks of a page that are not requests
LOG = logging.getLogger(__name__)


class Connection:
    """A page."""

    def __init__(
        self, socket: WebSocket, shared: SharedSession, solvers: Solvers, warm: asyncio.Event
    ) -> None:
        self._socket, self._shared, self._warm = socket, shared, warm
        self._sending = asyncio.Lock()
        self._tasks: set[asyncio.Task[None]] = set()
        self._events: asyncio.Queue[Any] = asyncio.Queue(limits.EVENTS)
        self._threads = ThreadPoolExecutor(2, thread_name_prefix="faces")
        self._requests = PageRequests(shared, self._threads, solvers, self._send)
        self._loop = asyncio.get_running_loop()

    async def run(self) -> None:
        """Answer requests until the page closes."""
        await self._socket.accept()
        self._shared.pages.add(self)
        self._keep(self._send_events())
        try:
            while True:
                message = await self._socket.receive()
                if message["type"] == "websocket.disconnect":
                    break
                self._begin(message.get("text"))
        except WebSocketDisconnect:
            pass
        finally:
            self._shared.pages.discard(self)
            for task in tuple(self._tasks):
                task.cancel()
            await asyncio.gather(*self._tasks, return_exceptions=True)
            await self._requests.close()
            self._threads.shutdown(wait=False)

    def tell(self, message: Any) -> None:
        """Queue an event; if the queue is full, the event is dropped."""
        with contextlib.suppress(asyncio.QueueFull):
            self._events.put_nowait(message)

    def _begin(self, text: str | None) -> None:
        if len(self._tasks) > limits.PENDING + OWN:
            self._keep(self._say(refusal(None, f"more than {limits.PENDING} requests at once")))
        elif len(self._tasks) <= 2 * limits.PENDING:
            self._keep(self._answered(text))

    def _keep(self, work: Any) -> None:
        task = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _answered(self, text: str | None) -> None:
        number: int | None = None
        try:
            if text is None:
                raise BadRequestError("the message is not text; expected JSON")
            request = decode(text)
            number = request.id
            reply = answer(number, await self._done(number, request.body))
        except BadRequestError as error:
            reply = refusal(error.id, error.message)
        except RisoriusError as error:
            reply = refusal(number, self._shared.session.files.told(str(error)))
        except Exception:
            # An error of ours: the page gets one line, the terminal the traceback.
            LOG.exception("a request failed")
            reply = refusal(number, "the studio failed; its terminal says why")
        await self._say(reply)

    async def _done(self, number: int, request: Any) -> Any:
        row = ROWS[type(request)]
        if row.of_page:
            return await row.handler(self._requests, number, request)
        with self._requests.running(number) as stopped:
            progress = stoppable(self._progress(number), stopped, "stopped")
            return await self._shared.handle(
                lambda session: row.handler(session, request, progress),
                self,
                changes=row.changes,
                saves=row.saves,
            )

    def _progress(self, number: int) -> Any:
        def told(stage: str, done: int = 0, total: int = 0) -> None:
            progress = events.ProgressEvent(stage, done, total, re=number)
            self._loop.call_soon_threadsafe(self.tell, progress)

        return told

    async def _say(self, text: str) -> None:
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            await self._send(text)

    async def _send(self, message: str | bytes) -> None:
        """Send a message after those before it."""
        async with self._sending:
            if isinstance(message, str):
                await self._socket.send_text(message)
            else:
                await self._socket.send_bytes(message)

    async def _send_events(self) -> None:
        if not self._warm.is_set():
            self.tell(events.Ready("warming"))
            self._keep(self._tell_warm())
        while True:
            await self._say(event(await self._events.get()))

    async def _tell_warm(self) -> None:
        await self._warm.wait()
        self.tell(events.Ready("warm"))
