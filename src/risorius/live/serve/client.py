"""One client: its messages in, its frames out. Its errors and unread frames delay nobody else."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import time
from collections.abc import Callable
from dataclasses import dataclass
from math import ceil

from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from ...errors import InputError, RisoriusError
from ...ports.mesh.rig import Rig
from ...settings import Settings
from ..frame import LiveFrame
from ..pace import Pace
from ..session import Live
from ..weights import LiveWeights
from . import limits
from .choices import settings_from
from .frame_queue import FrameQueue
from .frames import FrameLayout, written
from .guard import has_token
from .messages import (
    VERSION,
    ClientMessage,
    Close,
    Feel,
    Flush,
    Interrupt,
    Listen,
    LookAt,
    Output,
    Say,
    StartFace,
    decode,
)
from .token_bucket import TokenBucket

LOG = logging.getLogger(__name__)
# Codes with which a socket closes (RFC 6455, 7.4.1).
DONE, REFUSED, FAILED, BUSY = 1000, 1008, 1011, 1013


class GoodbyeError(Exception):
    """The client is told why, and its socket is closed."""

    def __init__(self, message: str, code: int = REFUSED) -> None:
        super().__init__(message)
        self.code = code


@dataclass(frozen=True, slots=True)
class Gate:
    """The conditions for clients: the token that they must send (None: no token), the `rig` that they may
    choose, and the function that makes a client's `face`.
    """

    token: str | None = None
    rig: Rig | None = None
    face: Callable[[Settings], Live] = Live


class LiveClient:
    """A client of the server, from its first message to its last frame."""

    def __init__(self, socket: WebSocket, gate: Gate) -> None:
        self._socket, self._gate = socket, gate
        self._queue = FrameQueue()
        self._messages = TokenBucket(limits.MESSAGES, limits.MESSAGES_AT_ONCE, time.monotonic)
        self._bytes = TokenBucket(limits.BYTES, limits.BYTES_AT_ONCE, time.monotonic)

    async def run(self) -> None:
        """Serve it until one side ends."""
        try:
            await self._serve()
            await self._close(DONE)
        except WebSocketDisconnect:
            pass
        except GoodbyeError as error:
            await self.dismiss(str(error), error.code)
        except Exception:
            # An error of ours: the client gets one line, the terminal the traceback.
            LOG.exception("a client's face failed")
            await self.dismiss("the server failed; its terminal says why", FAILED)

    async def dismiss(self, message: str, code: int) -> None:
        """Say why, and close."""
        with contextlib.suppress(RuntimeError, WebSocketDisconnect, TimeoutError):
            async with asyncio.timeout(1.0):
                await self._socket.send_text(written("error", message=message))
        await self._close(code)

    async def _close(self, code: int) -> None:
        if self._socket.application_state is WebSocketState.CONNECTED:
            with contextlib.suppress(RuntimeError, WebSocketDisconnect, TimeoutError):
                async with asyncio.timeout(1.0):
                    await self._socket.close(code)

    async def _serve(self) -> None:
        start = await self._start()
        layout, settings = self._wanted(start)
        self._queue = FrameQueue(max(1, ceil(start.ahead * settings.fps)))
        face, weights = await asyncio.to_thread(self._made, settings, layout)
        await self._socket.send_text(_started(layout, settings))
        parts = (self._play(face, weights, start.ahead), self._read(face), self._write(layout, start))
        tasks = [asyncio.create_task(part) for part in parts]
        try:
            # The writer ends when the last frame is sent, the reader when the client goes.
            ended, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            for task in ended:
                task.result()
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    async def _start(self) -> StartFace:
        """Return the first message, which must be allowed."""
        try:
            async with asyncio.timeout(limits.START):
                message = decode(await self._received())
        except TimeoutError:
            raise GoodbyeError(f"nothing came for {limits.START:g} s; expected 'start'") from None
        except RisoriusError as error:
            raise GoodbyeError(error.message) from None
        if not isinstance(message, StartFace):
            raise GoodbyeError("expected 'start' as the first message")
        if self._gate.token is not None and not has_token(
            self._socket.headers, self._gate.token, message.token
        ):
            raise GoodbyeError("wrong token; expected that of this server, in 'start' or as Bearer")
        return message

    def _wanted(self, start: StartFace) -> tuple[FrameLayout, Settings]:
        """Return the contents of frames, and the settings; a request that cannot be met ends it."""
        try:
            if start.version != VERSION:
                raise InputError(f"version {start.version}; expected {VERSION}")
            if Output.RIG in start.outputs and self._gate.rig is None:
                raise InputError("this server has no rig; expected it to be started with --rig FILE")
            return FrameLayout(start.outputs, self._gate.rig), settings_from(start)
        except RisoriusError as error:
            raise GoodbyeError(error.message) from None

    def _made(self, settings: Settings, layout: FrameLayout) -> tuple[Live, LiveWeights | None]:
        return self._gate.face(settings), LiveWeights(settings) if layout.fits else None

    async def _play(self, face: Live, weights: LiveWeights | None, ahead: float) -> None:
        """Put frames into the queue when their time has come; the last one however late it is."""
        frames, sentence = face.frames(waits=False), ""
        pace = Pace(face.fps, time.monotonic)
        late: LiveFrame | None = None
        while True:
            try:
                frame = await asyncio.to_thread(next, frames, None)
            except RisoriusError as error:
                self._queue.tell(written("error", message=str(error)))
                frames = face.frames(waits=False)
                continue
            if frame is None:
                break
            if late is not None:
                self._queue.drop(late)
                late = None
            if frame.text != sentence:
                sentence = frame.text
                self._queue.tell(written("sentence", text=sentence, index=frame.index))
            if (wait := pace.wait(frame.index) - ahead) > 0:
                await asyncio.sleep(wait)
            if pace.late(frame.index) > limits.LATE:
                late = frame
            else:
                await self._put(frame, weights)
        if late is not None:
            await self._put(late, weights)
        self._queue.end()
        await asyncio.Event().wait()

    async def _put(self, frame: LiveFrame, weights: LiveWeights | None) -> None:
        self._queue.put(frame if weights is None else await asyncio.to_thread(weights.added, frame))

    async def _write(self, layout: FrameLayout, start: StartFace) -> None:
        while (item := await self._queue.take()) is not None:
            message = item if isinstance(item, str) else layout.written(item, start.format)
            try:
                async with asyncio.timeout(limits.UNREAD):
                    await self._send(message)
            except TimeoutError:
                raise GoodbyeError(f"nothing was read for {limits.UNREAD:g} s") from None
        # After the frames, which other events overtake.
        await self._send(written("ended"))

    async def _send(self, message: str | bytes) -> None:
        if isinstance(message, str):
            await self._socket.send_text(message)
        else:
            await self._socket.send_bytes(message)

    async def _read(self, face: Live) -> None:
        while True:
            try:
                message = decode(await self._received())
                if isinstance(message, Interrupt):
                    # It waits for what is being heard.
                    unsaid = await asyncio.to_thread(face.interrupt)
                    self._queue.tell(written("interrupted", unsaid=unsaid))
                else:
                    follow(face, message)
            except RisoriusError as error:
                self._queue.tell(written("error", message=error.message))

    async def _received(self) -> str:
        """Return the next message; raises InputError if it is not a text."""
        message = await self._socket.receive()
        if message["type"] == "websocket.disconnect":
            raise WebSocketDisconnect(message.get("code", DONE))
        text = message.get("text")
        size = len(text or message.get("bytes") or b"")
        if not self._messages.take() or not self._bytes.take(size):
            raise GoodbyeError(
                f"too much at once; expected at most {limits.MESSAGES:g} messages and "
                f"{limits.BYTES / 1e6:g} MB a second"
            )
        if text is None:
            raise InputError("the message is not text; expected JSON")
        return str(text)


def follow(face: Live, message: ClientMessage) -> None:
    """Obey a message; raises RisoriusError."""
    match message:
        case Say():
            sound = message.sound
            face.say(
                message.text or "",
                audio=sound,
                rate=message.rate,
                encoding=message.encoding,
                words=message.words,
            )
        case LookAt():
            face.look(message.direction)
        case Feel():
            face.feel(message.emotion, message.intensity)
        case Listen():
            face.listen(message.samples, message.rate)
        case Flush():
            face.flush()
        case Close():
            face.close()
        case StartFace():
            raise InputError("the face has started already; expected 'start' once")


def _started(layout: FrameLayout, settings: Settings) -> str:
    """Return the event `started`, with the names of a frame's values."""
    columns = {str(output): list(names) for output, names in layout.names.items()}
    return written("started", version=VERSION, fps=float(settings.fps), head=settings.head, **columns)
