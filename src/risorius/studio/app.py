"""The routes: the page and its files, the catalogue, heads and sounds, and the sockets of the sessions."""

from __future__ import annotations

import asyncio
import json
import threading
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from functools import lru_cache
from pathlib import Path

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.websockets import WebSocket

from ..api import speak
from ..browser import ROOT
from ..errors import InputError, RisoriusError, unknown
from ..face.head.head import shipped_heads
from ..live.serve.guard import Guard
from ..live.serve.pages import parts
from ..live.serve.pictures import PictureServer
from ..live.serve.server import LiveServer, ServeOptions
from ..ports.page.head_glb import head_glb
from ..ports.page.head_shade import shade
from ..ports.page.skin_formulas import skin_tables
from . import limits
from .catalogue import catalogue_json
from .connection import Connection
from .faces.solvers import Solvers, stage_of
from .project import session_list
from .project.exports import ARCHIVE
from .project.session_list import NAME
from .shared_session import SharedSession
from .uploads import TooLargeError, sweep, to_file, to_memory
from .wire.messages import encoded

SAME_FOR_AN_HOUR = {"cache-control": "private, max-age=3600"}


class Studio:
    """The server's state: its folder, the open sessions, the warm solvers."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.sessions: dict[str, SharedSession] = {}
        self.solvers = Solvers()
        self.warm = asyncio.Event()

    def session(self, name: str, *, create: bool = True) -> SharedSession:
        """Return a session by its name: open it if it is closed, create it if it is missing and `create`.

        Raises InputError if the name is not valid, the session does not exist, or too many are open.
        """
        if not NAME.fullmatch(name):
            raise InputError("the session's name cannot be used; expected 1 to 40 of a-z, 0-9 and -")
        if name not in self.sessions:
            folder = self.folder / name
            if not create and not folder.is_dir():
                raise InputError(f"there is no session '{name}'")
            self._close_unseen()
            folder.mkdir(parents=True, exist_ok=True)
            self.sessions[name] = SharedSession(name, folder)
        return self.sessions[name]

    def _close_unseen(self) -> None:
        """If too many sessions are open, close the oldest one that no page shows."""
        if len(self.sessions) < limits.SESSIONS:
            return
        unseen = next((name for name, shared in self.sessions.items() if not shared.pages), None)
        if unseen is None:
            raise InputError(f"{limits.SESSIONS} sessions are open already; close one first")
        self.sessions.pop(unseen).close()

    def app(self) -> Starlette:
        """Return the application."""
        routes = [
            Route("/", page),
            parts(),
            PictureServer().route(),
            Route("/api/catalogue", catalogue),
            Route("/api/head", head),
            Route("/api/stage", stage),
            Route("/api/shade", shading),
            Route("/api/folds", folds),
            Route("/api/skin", skin),
            Route("/api/session/{session}/take/{take:int}/sound.wav", self.sound),
            Route("/api/sessions", self.list_sessions),
            Route("/api/session/{session}/rename", self.rename_session, methods=["POST"]),
            Route("/api/session/{session}/copy", self.copy_session, methods=["POST"]),
            Route("/api/session/{session}/delete", self.delete_session, methods=["POST"]),
            Route("/api/session/{session}/put-back", self.put_back_session, methods=["POST"]),
            Route("/api/session/{session}/recording", self.recording, methods=["POST"]),
            Route("/api/session/{session}/project", self.project),
            Route("/api/session/{session}/project", self.open_project, methods=["POST"]),
            Route("/api/session/{session}/export/{job:int}/{file}", self.export),
            WebSocketRoute("/ws/{session}", self.socket),
            Mount("/live", routes=LiveServer(ServeOptions()).routes()),
        ]
        guard = [Middleware(Guard)]
        refusals = {RisoriusError: _refused}
        return Starlette(
            routes=routes, middleware=guard, exception_handlers=refusals, lifespan=self._lifespan
        )

    @asynccontextmanager
    async def _lifespan(self, app: Starlette) -> AsyncIterator[None]:
        loop = asyncio.get_running_loop()

        def warm() -> None:
            warm_up(self.solvers)
            # If the server has ended meanwhile, the loop is closed.
            with suppress(RuntimeError):
                loop.call_soon_threadsafe(self.warm.set)

        await run_in_threadpool(sweep, self.folder)
        threading.Thread(target=warm, name="warming", daemon=True).start()
        yield
        for shared in self.sessions.values():
            await shared.finish()

    async def socket(self, socket: WebSocket) -> None:
        """Serve a page's socket."""
        try:
            shared = self.session(socket.path_params["session"])
        except InputError:
            await socket.close(1008)
            return
        await Connection(socket, shared, self.solvers, self.warm).run()

    async def list_sessions(self, request: Request) -> Response:
        """Return the sessions, the latest first."""
        shown = {name for name, shared in self.sessions.items() if shared.pages}
        entries = await run_in_threadpool(session_list.listed, self.folder, shown)
        return JSONResponse(encoded(entries), headers={"cache-control": "no-store"})

    async def rename_session(self, request: Request) -> Response:
        """Give a session a name for people: `title` in the query."""
        session_list.rename(self._existing(request), request.query_params.get("title", ""))
        return JSONResponse({})

    async def copy_session(self, request: Request) -> Response:
        """Copy a session as it is now; `session` in the answer is the name of the copy."""
        source, name = self._existing(request), session_list.new_name()
        opened = self.sessions.get(source.name)

        def copy() -> None:
            session_list.copy(source, self.folder / name)

        await (opened.alone(copy) if opened else run_in_threadpool(copy))
        return JSONResponse({"session": name})

    async def delete_session(self, request: Request) -> Response:
        """Delete a session that no page shows; until another of its name is deleted it can be put back."""
        folder = self._existing(request)
        opened = self.sessions.get(folder.name)
        if opened is not None and opened.pages:
            raise InputError("the session is open in a tab; expected it to be closed first")
        if opened is not None:
            del self.sessions[folder.name]
            await opened.finish()
        await run_in_threadpool(session_list.delete, self.folder, folder.name)
        return JSONResponse({})

    async def put_back_session(self, request: Request) -> Response:
        """Put a deleted session back."""
        await run_in_threadpool(session_list.put_back, self.folder, request.path_params["session"])
        return JSONResponse({})

    def _existing(self, request: Request) -> Path:
        """Return the folder of a session that exists."""
        name: str = request.path_params["session"]
        folder = self.folder / name
        if not NAME.fullmatch(name) or not folder.is_dir():
            raise InputError(f"there is no session '{name[:40]}'")
        return folder

    async def sound(self, request: Request) -> Response:
        """Return a take's sound."""
        live = self._requested(request).session.live(request.path_params["take"])
        audio = live.take.utterance.audio if live.take.utterance else None
        if audio is None:
            raise InputError("this take has no sound")
        return FileResponse(audio.path, media_type="audio/wav", headers={"cache-control": "no-cache"})

    async def recording(self, request: Request) -> Response:
        """Save a recording: the body is the file, `name` in the query its name."""
        shared = self._requested(request)
        uploaded = await to_file(request, shared.session.folder, limits.RECORDING)
        try:
            name = await shared.add_recording(request.query_params.get("name", ""), uploaded)
        finally:
            uploaded.unlink(missing_ok=True)
        return JSONResponse({"recording": name})

    async def project(self, request: Request) -> Response:
        """Return the project as a file."""
        data = await self._requested(request).project()
        named = {"content-disposition": 'attachment; filename="performance.risorius.json"'}
        return Response(data, media_type="application/json", headers=named)

    async def open_project(self, request: Request) -> Response:
        """Open an uploaded project; the session's pages are told."""
        shared = self._requested(request)
        await shared.open_project(await to_memory(request, limits.PROJECT))
        return JSONResponse({})

    async def export(self, request: Request) -> Response:
        """Return a file that an export has written, or all of them as one archive."""
        name = request.path_params["file"]
        exports, job = self._requested(request).exports, request.path_params["job"]
        path = await run_in_threadpool(exports.archive, job) if name == ARCHIVE else exports.file(job, name)
        return FileResponse(path, filename=name)

    def _requested(self, request: Request) -> SharedSession:
        return self.session(request.path_params["session"], create=request.method == "POST")


def warm_up(solvers: Solvers) -> None:
    """Load and compile everything that the first line, the first face and the head's file need."""
    catalogue_json()
    solvers.warm()
    speak("Hm.", text=True)
    _glb("standard", None, None, None)
    _shaded("standard", None, None, None)


async def page(request: Request) -> Response:
    """Return the page."""
    return FileResponse(ROOT / "studio" / "index.html", headers={"cache-control": "no-cache"})


async def catalogue(request: Request) -> Response:
    """Return all tables."""
    data = await run_in_threadpool(catalogue_json)
    return Response(data, media_type="application/json", headers={"cache-control": "no-cache"})


async def head(request: Request) -> Response:
    """Return a head at rest as `.glb`."""
    return await _of_head(request, _glb, "model/gltf-binary")


async def stage(request: Request) -> Response:
    """Return how a head's faces are unpacked (Stage in `browser/wire.js`)."""
    return await _of_head(request, _described, "application/json")


async def shading(request: Request) -> Response:
    """Return the light that reaches each vertex of a head's skin (`head_shade.py`)."""
    return await _of_head(request, _shaded, "application/octet-stream")


async def folds(request: Request) -> Response:
    """Return where the fine wrinkles of a head lie (`head_wrinkles.py`)."""
    return await _of_head(request, _folds, "application/octet-stream")


async def skin(request: Request) -> Response:
    """Return the tables that skin is shaded by (`skin_formulas.py`)."""
    data = await run_in_threadpool(skin_tables)
    return Response(data, media_type="application/octet-stream", headers=SAME_FOR_AN_HOUR)


async def _of_head(request: Request, make: Callable[..., bytes], kind: str) -> Response:
    data = await run_in_threadpool(make, *looks_of(request))
    return Response(data, media_type=kind, headers=SAME_FOR_AN_HOUR)


def looks_of(request: Request) -> tuple[str, float | None, str | None, float | None]:
    """Return which head a request wants and how it looks; raise InputError for a head that there is not."""
    query = request.query_params
    name = query.get("head", "standard")
    if name not in shipped_heads():
        raise InputError(unknown("head", name, shipped_heads()))
    return name, _number(query.get("age")), query.get("hair") or None, _number(query.get("complexion"))


def _number(text: str | None) -> float | None:
    try:
        return float(text) if text else None
    except ValueError:
        raise InputError(f"'{text}' is not a number") from None


@lru_cache(maxsize=4)
def _glb(head: str, age: float | None, hair: str | None, complexion: float | None) -> bytes:
    return head_glb(stage_of(head, age, hair, complexion))


@lru_cache(maxsize=8)
def _shaded(head: str, age: float | None, hair: str | None, complexion: float | None) -> bytes:
    return shade(stage_of(head, age, hair, complexion).head)


def _folds(head: str, age: float | None, hair: str | None, complexion: float | None) -> bytes:
    return stage_of(head, age, hair, complexion).folds.places()


def _described(head: str, age: float | None, hair: str | None, complexion: float | None) -> bytes:
    return json.dumps(encoded(stage_of(head, age, hair, complexion).described())).encode()


async def _refused(request: Request, error: Exception) -> Response:
    """Answer with one line: 413 for a file that is too large, 404 for a missing one, else 400."""
    status = 413 if isinstance(error, TooLargeError) else 404 if request.method == "GET" else 400
    return PlainTextResponse(f"{error}\n", status_code=status)
