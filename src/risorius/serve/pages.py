"""Files that browsers get from the server: the example page, its module, and heads."""

from __future__ import annotations

import tempfile
from collections.abc import Awaitable, Callable
from functools import lru_cache
from importlib import resources
from pathlib import Path

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles

from ..errors import unknown
from ..face.head import load_head, shipped_heads
from ..ports.glb import rig_scene
from ..ports.gltf import Gltf
from ..ports.page_modules import WEB as PARTS
from .choices import NAMES

WEB = Path(str(resources.files(__package__) / "web"))
FILES = {
    "/": WEB / "index.html",
    "/live.css": WEB / "live.css",
    "/page.js": WEB / "page.js",
    "/risorius-live.js": WEB / "risorius-live.js",
    # Browsers ask for it beside every answer that is no page.
    "/favicon.ico": PARTS / "icon.svg",
}
KEPT = 3
"""Heads whose files are kept, of 16 MB each."""


def routes() -> list[BaseRoute]:
    """Return the routes of the page."""
    return [
        *(Route(path, _sender(file)) for path, file in FILES.items()),
        Route("/about.json", about),
        Route("/head.glb", head),
    ]


def parts() -> Mount:
    """Return the route of what the page has in common with others."""
    return Mount("/web", StaticFiles(directory=PARTS))


async def about(request: Request) -> Response:
    """Tell which heads there are, and which settings a client may choose."""
    return JSONResponse({"heads": list(shipped_heads()), "settings": list(NAMES)})


async def head(request: Request) -> Response:
    """Send a head with ARKit's shapes as morph targets: `head` in the query."""
    name = request.query_params.get("head", "standard")
    if name not in shipped_heads():
        return PlainTextResponse(unknown("head", name[:40], shipped_heads()), status_code=404)
    content = await run_in_threadpool(_rig, name)
    return Response(
        content, media_type="model/gltf-binary", headers={"cache-control": "private, max-age=3600"}
    )


@lru_cache(maxsize=KEPT)
def _rig(name: str) -> bytes:
    gltf = Gltf(generator="Risorius", copyright="Head: CC0 1.0")
    rig_scene(load_head(name), gltf)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "head.glb"
        gltf.save(path)
        return path.read_bytes()


def _sender(file: Path) -> Callable[[Request], Awaitable[Response]]:
    async def send(request: Request) -> Response:
        return FileResponse(file, headers={"cache-control": "no-cache"})

    return send
