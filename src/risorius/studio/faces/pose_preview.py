"""Preview of a pose: answer each turn of a dial with the values; send faces until the skin rests."""

from __future__ import annotations

import asyncio
import contextlib
from concurrent.futures import Executor
from contextlib import ExitStack

import numpy as np

from ...core.arrays import Array
from ...core.parameters import NAMES
from ...errors import InputError, unknown
from ...face.head.head import shipped_heads
from ...ports.page.face_packer import DIALLED
from ...settings import Settings
from ..session.session_files import SessionFiles
from ..threads import on_thread
from ..wire import answers, requests
from .pose_editor import SETTLED, PoseEditor, dialled
from .solvers import Solvers, stage_of
from .streaming import Send

RATE = 30.0  # faces a second while the skin moves
SOONEST = 1.0 / 60.0  # seconds between two faces at least, if a dial was turned
DRAGGED = 0.1  # seconds between turns of a dial that is dragged
PATIENCE = 2.0 / RATE  # seconds after a face to wait for the next turn of a dragged dial


class PosePreview:
    """The pose that one page sets by its dials."""

    def __init__(self, threads: Executor, solvers: Solvers, send: Send) -> None:
        self._threads, self._solvers, self._send = threads, solvers, send
        self._loop = asyncio.get_running_loop()
        self._held = ExitStack()
        self._looks: tuple[str, float | None] | None = None
        self._dial: PoseEditor | None = None
        self._values: Array = np.zeros(len(NAMES))
        self._number, self._until = 0, 0.0
        self._last_turn, self._dragged = 0.0, False
        self._moving: asyncio.Task[None] | None = None
        self._turning = asyncio.Lock()
        self._turned = asyncio.Event()

    async def turn(self, number: int, request: requests.Dial, files: SessionFiles) -> answers.DialState:
        """Set new values; send the faces on the way there as they are solved. Raises ParameterError."""
        if request.head not in shipped_heads():
            raise InputError(unknown("head", request.head, shipped_heads()))
        emotions = {files.emotion(name): value for name, value in request.emotions.items()}
        values = dialled(request.values, emotions)
        async with self._turning:
            if self._looks != (request.head, request.age):
                await self._take_head(request.head, request.age)
        self._values = np.array(list(values.values()))
        now = self._loop.time()
        self._number, self._until = number, now + (SETTLED if request.live else 0.0)
        self._last_turn, self._dragged = now, now - self._last_turn < DRAGGED
        self._turned.set()
        if self._moving is None or self._moving.done():
            self._moving = self._loop.create_task(self._move())
        return answers.DialState(values)

    async def stop(self) -> None:
        """Stop sending faces and return the solver."""
        if self._moving is not None:
            self._moving.cancel()
            await asyncio.wait([self._moving])
        self._held.close()

    async def _take_head(self, head: str, age: float | None) -> None:
        await self.stop()
        lent = self._solvers.lent(Settings(head=head, age=age))
        solver = await on_thread(self._threads, lent.__enter__)
        self._held.push(lent.__exit__)
        self._dial, self._looks = PoseEditor(solver), (head, age)

    async def _move(self) -> None:
        """Send faces until the skin rests and no dial was turned meanwhile; the last face is at rest."""
        before = self._loop.time() - 1.0 / RATE
        shown = None
        while shown != self._number:
            while (now := self._loop.time()) < self._until:
                await self._show(now - before)
                before = now
                await self._pause(now)
            shown = self._number
            await self._show(None)

    async def _pause(self, last: float) -> None:
        """Wait until the next face is due after that of the time `last`: sooner if a dial is turned.

        While a dial is dragged, wait for its next turn: a face of the old position would delay the next one.
        """
        await asyncio.sleep(max(0.0, last + SOONEST - self._loop.time()))
        dragged = self._dragged and self._loop.time() - self._last_turn < DRAGGED
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout_at(last + (PATIENCE if dragged else 1.0 / RATE)):
                await self._turned.wait()
        self._turned.clear()

    async def _show(self, seconds: float | None) -> None:
        dial, values, number = self._dial, self._values, self._number
        assert dial is not None
        assert self._looks is not None
        head, age = self._looks

        def face() -> bytes:
            frame = dial.still(values) if seconds is None else dial.moved(values, seconds)
            return stage_of(head, age).packed(DIALLED, number, 0, [frame])

        await self._send(await on_thread(self._threads, face))
