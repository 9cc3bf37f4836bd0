"""Running the server of live faces."""

from __future__ import annotations

import asyncio
import contextlib
import ipaddress
import logging
import socket
import threading
from collections.abc import AsyncIterator, Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager
from dataclasses import dataclass

import uvicorn
from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response
from starlette.routing import BaseRoute, Route, WebSocketRoute
from starlette.websockets import WebSocket

from ...api import speak
from ...errors import InputError, RisoriusError
from ...ports.mesh.rig import Rig
from ...settings import Settings
from ..process_performer import warm_processes
from ..session import Live
from . import limits, pages
from .client import BUSY, Gate, LiveClient
from .guard import HOSTS, Guard
from .listening import HOST, bound, server_config
from .pictures import PictureServer

PORT = 8766
LOG = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class ServeOptions:
    """The options of a server: its address, its clients, and the faces that it makes.

    `token`: what clients must send; needed if other machines can reach `host`. `origins`: pages of other
    servers that may connect. `clients`: how many at once. `rig`: the character whose morph targets are sent.
    `face` makes a client's face of its settings: an agent's face answers, others say what they are given.
    Raises InputError for a server that anybody could use.
    """

    host: str = HOST
    port: int = PORT
    token: str | None = None
    origins: Sequence[str] = ()
    clients: int = limits.CLIENTS
    rig: Rig | None = None
    face: Callable[[Settings], Live] = Live

    def __post_init__(self) -> None:
        if self.token is not None and len(self.token) < limits.TOKEN:
            raise InputError(f"a token of {len(self.token)} characters; expected at least {limits.TOKEN}")
        if self.token is None and not is_loopback(self.host):
            raise InputError(
                f"{self.host} can be reached from other machines; expected a token "
                "(--token-file, or the variable RISORIUS_TOKEN)"
            )


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches an address."""
    try:
        return host == "localhost" or ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


class LiveServer:
    """The clients of a server."""

    def __init__(self, options: ServeOptions) -> None:
        self._options = options
        self._gate = Gate(options.token, options.rig, options.face)
        self.clients: set[LiveClient] = set()

    def app(self) -> Starlette:
        """Return the application."""
        hosts = HOSTS if is_loopback(self._options.host) else None
        guard = Middleware(Guard, hosts=hosts, origins=tuple(self._options.origins))
        pictures = PictureServer(self._options.token)
        routes = [Route("/health", self.health), *self.routes(), pages.parts(), pictures.route()]
        return Starlette(routes=routes, middleware=[guard], lifespan=self._lifespan)

    def routes(self) -> list[BaseRoute]:
        """Return the routes of the page and its socket; a server also needs `pages.parts` and pictures."""
        return [WebSocketRoute("/live", self.face), *pages.routes()]

    async def health(self, request: Request) -> Response:
        """Tell that the server runs, and for how many."""
        return JSONResponse({"clients": len(self.clients)}, headers={"cache-control": "no-store"})

    async def face(self, socket: WebSocket) -> None:
        """Serve a client."""
        await socket.accept()
        client = LiveClient(socket, self._gate)
        if len(self.clients) >= self._options.clients:
            await client.dismiss(f"{self._options.clients} clients are here; expected fewer", BUSY)
            return
        self.clients.add(client)
        try:
            await client.run()
        finally:
            self.clients.discard(client)

    @asynccontextmanager
    async def _lifespan(self, app: Starlette) -> AsyncIterator[None]:
        # Each client performs in a thread; none waits for another's.
        threads = ThreadPoolExecutor(2 * self._options.clients, thread_name_prefix="live")
        asyncio.get_running_loop().set_default_executor(threads)
        yield


def warm_up() -> None:
    """Load and compile ahead for the first client, beside the process that performs for it."""
    warm_processes()
    try:
        speak("Hello.", text=True)
        next(Live(arkit=True).frames(waits=False))
    except RisoriusError as error:
        # The clients are told when they come.
        LOG.warning("%s", error)


def serve(options: ServeOptions, say: Callable[[str], None] = print) -> None:
    """Serve live faces until interrupted; tell the address. Raises OutputError if the port is taken."""
    listening = listener(options)
    shown = f"[{options.host}]" if ":" in options.host else options.host
    server = uvicorn.Server(configured(LiveServer(options)))
    say(f"Live faces are at http://{shown}:{listening.getsockname()[1]}/ (Ctrl+C ends it)")
    threading.Thread(target=warm_up, name="warming", daemon=True).start()
    # Interrupted is how a server ends.
    with contextlib.suppress(KeyboardInterrupt):
        server.run(sockets=[listening])


def listener(options: ServeOptions) -> socket.socket:
    """Return the socket that listens; raises OutputError if it cannot.

    Its clients' have small buffers: what the system keeps for one that reads slowly comes late to it.
    """
    listening = bound(options.port, options.host)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, limits.SEND_BUFFER)
    return listening


def configured(live: LiveServer) -> uvicorn.Config:
    """Return how uvicorn runs it."""
    return server_config(live.app(), limits.MESSAGE)
