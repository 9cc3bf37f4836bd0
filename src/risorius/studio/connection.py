"""One page's socket: requests in, answers and faces out; one that reads slowly holds up only itself."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from ..errors import InputError, RisoriusError
from . import limits, wire
from .messages import BadRequestError, answer, decode, event, refusal
from .session import Session
from .solvers import Solvers, stage_of
from .stage import FRAMES, MOMENT

CHUNK = 4  # faces to a message
LEAD_IN = 1.0  # seconds from which on the skin's motion before the first face counts


class Room:
    """A session with its pages: a thread for what changes it, the pages that hear of it."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.worker = ThreadPoolExecutor(1, thread_name_prefix=f"session-{session.name}")
        self.pages: set[Connection] = set()


class Connection:
    """A page."""

    def __init__(self, socket: WebSocket, room: Room, solvers: Solvers) -> None:
        self._socket, self._room, self._solvers = socket, room, solvers
        self._sending = asyncio.Lock()
        self._tasks: set[asyncio.Task[None]] = set()
        self._streams: dict[int, asyncio.Event] = {}
        self._faces = ThreadPoolExecutor(1, thread_name_prefix="faces")

    async def run(self) -> None:
        """Answer requests until the page goes."""
        await self._socket.accept()
        self._room.pages.add(self)
        try:
            while True:
                self._begin(await self._socket.receive_text())
        except (WebSocketDisconnect, KeyError):
            pass  # gone, or it sent bytes
        finally:
            self._room.pages.discard(self)
            for stop in self._streams.values():
                stop.set()
            for task in self._tasks:
                task.cancel()
            self._faces.shutdown(wait=False, cancel_futures=True)

    def _begin(self, text: str) -> None:
        task = asyncio.get_running_loop().create_task(self._answered(text))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _answered(self, text: str) -> None:
        number: int | None = None
        try:
            request = decode(text)
            number = request.id
            if len(self._tasks) > limits.PENDING:
                raise InputError(f"more than {limits.PENDING} requests at once")
            reply = answer(number, await self._done(number, request.asked))
        except BadRequestError as error:
            reply = refusal(error.id, error.message)
        except RisoriusError as error:
            reply = refusal(number, str(error))
        except (RuntimeError, WebSocketDisconnect):
            return  # gone
        await self.send(reply)

    async def send(self, message: str | bytes) -> None:
        """Send a message when those before it are on their way."""
        async with self._sending:
            if isinstance(message, str):
                await self._socket.send_text(message)
            else:
                await self._socket.send_bytes(message)

    async def _done(self, number: int, asked: Any) -> Any:
        if isinstance(asked, wire.Faces):
            return await self._stream(asked)
        if isinstance(asked, wire.FaceAt):
            return await self._moment(asked)
        if isinstance(asked, wire.Cancel):
            if asked.take in self._streams:
                self._streams[asked.take].set()
            return wire.Done()
        method: Callable[..., Any] = getattr(self._room.session, _METHODS[type(asked)])
        loop = asyncio.get_running_loop()

        def progress(stage: str, done: int = 0, total: int = 0) -> None:
            told = wire.Progress(stage, done, total, re=number)
            asyncio.run_coroutine_threadsafe(self.send(event(told)), loop)

        return await loop.run_in_executor(self._room.worker, method, asked, progress)

    async def _stream(self, asked: wire.Faces) -> wire.Sent:
        live = self._room.session.live(asked.take)
        last = min(asked.last, len(live.take.performance.values))
        if asked.take in self._streams:
            self._streams[asked.take].set()
        stop = self._streams[asked.take] = asyncio.Event()
        loop, sent = asyncio.get_running_loop(), 0
        settings = live.take.settings
        stage = await loop.run_in_executor(self._faces, stage_of, settings.head, settings.age)
        with self._solvers.lent(settings) as solver:
            faces = live.take.faces(range(asked.first, last), lead_in=LEAD_IN, solver=solver)

            def chunk(first: int) -> bytes:
                some = [next(faces) for _ in range(min(CHUNK, last - first))]
                return stage.packed(FRAMES, asked.take, first, some)

            for first in range(asked.first, last, CHUNK):
                if stop.is_set():
                    break
                await self.send(await loop.run_in_executor(self._faces, chunk, first))
                sent = min(first + CHUNK, last) - asked.first
        if self._streams.get(asked.take) is stop:
            del self._streams[asked.take]
        return wire.Sent(sent)

    async def _moment(self, asked: wire.FaceAt) -> wire.Sent:
        live = self._room.session.live(asked.take)
        loop = asyncio.get_running_loop()

        def face() -> bytes:
            settings = live.take.settings
            frame = round(asked.time * live.take.performance.fps)
            frame = min(frame, len(live.take.performance.values) - 1)
            with self._solvers.lent(settings) as solver:
                found = list(live.take.faces([frame], lead_in=LEAD_IN, solver=solver))
            return stage_of(settings.head, settings.age).packed(MOMENT, asked.take, frame, found)

        await self.send(await loop.run_in_executor(self._faces, face))
        return wire.Sent(1)


_METHODS = {cls: name for name, cls in wire.VERBS.items()} | dict.fromkeys(wire.EDITS.values(), "edit")
