"""Files that browsers get from the server: the example page, its module, and heads."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Awaitable, Callable
from functools import lru_cache
from pathlib import Path
from typing import Any

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import FileResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles

from ...browser import ROOT
from ...errors import unknown
from ...face.head.head import load_head, shipped_heads
from ...ports.mesh.glb import rig_scene
from ...ports.mesh.gltf import Gltf
from .choices import NAMES

FILES = {
    "/": ROOT / "live" / "index.html",
    "/risorius-live.js": ROOT / "live" / "risorius-live.js",
    # Browsers ask for it beside every answer that is not a page.
    "/favicon.ico": ROOT / "icon.svg",
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
    """Return the route of all that pages are made of."""
    return Mount("/web", PageFiles(directory=ROOT))


class PageFiles(StaticFiles):
    """The files of the pages. The browser asks each time whether they have changed.

    Otherwise it would mix those of two versions of Risorius.
    """

    def lookup_path(self, path: str) -> tuple[str, os.stat_result | None]:
        """Return the file at a path; nothing for the package's Python."""
        return ("", None) if path.endswith((".py", ".pyc")) else super().lookup_path(path)

    def file_response(self, *arguments: Any, **named: Any) -> Response:
        """Return the answer with a file."""
        response = super().file_response(*arguments, **named)
        response.headers["cache-control"] = "no-cache"
        return response


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
