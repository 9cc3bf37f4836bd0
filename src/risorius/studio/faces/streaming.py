"""Faces of a take to a page: a window at a time, solved on a thread while the page reads the ones before."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterator
from concurrent.futures import Executor

from ...face.frame import FaceFrame
from ...face.solve import FaceSolver
from ...ports.page.face_packer import FRAMES, MOMENT, FacePacker
from ...settings import Settings
from ...take import Take
from ..session.session import SessionTake
from ..threads import on_thread
from ..wire import answers, requests
from .solvers import Solvers, stage_of

Send = Callable[[bytes], Awaitable[None]]
CHUNK = 4  # faces to a message
LEAD = 1.0  # seconds of a window that are sent as quickly as they come
LEAD_IN = 1.0  # seconds of motion before the first face that count


class Streams:
    """The windows that one page is being sent, one for each take."""

    def __init__(self, threads: Executor, solvers: Solvers, send: Send) -> None:
        self._threads, self._solvers, self._send = threads, solvers, send
        self._stopped: dict[int, asyncio.Event] = {}

    async def send(self, live: SessionTake, request: requests.Faces) -> answers.FacesSent:
        """Send a window; the previous one of the same take ends."""
        self.cancel(request.take)
        stopped = self._stopped[request.take] = asyncio.Event()
        last = min(request.last, len(live.take.performance.values))
        first, settings = request.first, live.take.settings
        begun = asyncio.get_running_loop().time()
        stage = await on_thread(self._threads, lambda: stage_for(settings))
        async with self._solvers.loan(settings, self._threads) as solver:
            faces = live.take.faces(range(first, last), lead_in=LEAD_IN, solver=solver)
            while first < last and not stopped.is_set():
                # The first by itself: playing waits for it.
                count = min(CHUNK if first > request.first else 1, last - first)
                message = await on_thread(self._threads, _chunk(stage, request.take, first, count, faces))
                await self._send(message)
                first += count
                if request.pace is not None:
                    ahead = (first - request.first) - LEAD * live.take.performance.fps
                    await until(begun + float(ahead) / request.pace)
        if self._stopped.get(request.take) is stopped:
            del self._stopped[request.take]
        return answers.FacesSent(max(first - request.first, 0))

    async def moment(self, live: SessionTake, request: requests.FaceAt) -> answers.FacesSent:
        """Send the face at a time."""
        if request.still:
            return await self.held(live.take, request.take, request.time)

        def solved(frame: int, solver: FaceSolver) -> FaceFrame:
            return next(iter(live.take.faces([frame], lead_in=LEAD_IN, solver=solver)))

        return await self._face(live.take, request.take, request.time, solved)

    async def held(self, take: Take, number: int, time: float) -> answers.FacesSent:
        """Send the face at a time of a take, the skin at rest, as that of take `number`."""

        def solved(frame: int, solver: FaceSolver) -> FaceFrame:
            return solver.solve(take.performance.values[frame])

        return await self._face(take, number, time, solved)

    async def _face(
        self, take: Take, number: int, time: float, solved: Callable[[int, FaceSolver], FaceFrame]
    ) -> answers.FacesSent:
        def face() -> bytes:
            performance, settings = take.performance, take.settings
            frame = min(round(time * performance.fps), len(performance.values) - 1)
            with self._solvers.lent(settings) as solver:
                face_frame = solved(frame, solver)
            return stage_for(settings).packed(MOMENT, number, frame, [face_frame])

        await self._send(await on_thread(self._threads, face))
        return answers.FacesSent(1)

    def cancel(self, take: int) -> None:
        """Stop sending a take's window if there is one."""
        if take in self._stopped:
            self._stopped[take].set()


async def until(time: float) -> None:
    """Wait until a time of the loop's clock."""
    await asyncio.sleep(max(0.0, time - asyncio.get_running_loop().time()))


def stage_for(settings: Settings) -> FacePacker:
    """Return the stage on which a take is shown."""
    return stage_of(settings.head, settings.age, settings.look.hair, settings.look.complexion)


def _chunk(
    stage: FacePacker, take: int, first: int, count: int, faces: Iterator[FaceFrame]
) -> Callable[[], bytes]:
    return lambda: stage.packed(FRAMES, take, first, [next(faces) for _ in range(count)])
