"""Draft pictures of a face, for pages whose browser draws without a graphics card: `GET /picture.webp`."""

from __future__ import annotations

import io
import threading
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from PIL import Image
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import QueryParams
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route

from ...core.arrays import ByteArray
from ...core.parameters import NAMES, NEUTRAL, PARAMETERS
from ...errors import InputError, RisoriusError, unknown
from ...face.head.head import shipped_heads
from ...face.solve import FaceSolver
from ...looks.apply_look import apply_look
from ...looks.head_model import head_model
from ...render.camera import Camera
from ...render.framing import frame_head
from ...render.software_renderer import SoftwareRenderer
from ...settings import Look, Settings
from ...solvers import SolverCache
from .guard import has_token

K = TypeVar("K")
V = TypeVar("V")
HEIGHT = 360
"""Rows of a picture."""
WIDTHS = range(180, 1081, 20)
"""How wide pictures are drawn; another width is drawn as the nearest of these."""
WAITING = 8
"""Requests that may wait for their turn."""
KEPT = 2
"""Heads whose solvers and renderers are kept: those of a comparison."""
QUALITY = 80
_LOWEST, _HIGHEST = (np.array([getattr(p, end) for p in PARAMETERS]) for end in ("low", "high"))


@dataclass(frozen=True, slots=True)
class Person:
    """The head that is drawn, and its look."""

    head: str
    age: float | None = None
    hair: str | None = None
    complexion: float | None = None


@dataclass(frozen=True, slots=True)
class PictureQuery:
    """A page's request. `values` are those of all parameters; without a camera the head is framed."""

    person: Person
    width: int
    camera: Camera | None
    values: tuple[float, ...]


def picture_query(query: QueryParams) -> PictureQuery:
    """Return what a query asks for; raise InputError for what cannot be drawn."""
    head = query.get("head", "standard")
    if head not in shipped_heads():
        raise InputError(unknown("head", head[:40], shipped_heads()))
    person = Person(head, _number(query, "age"), query.get("hair") or None, _number(query, "complexion"))
    width = _number(query, "width") or HEIGHT
    nearest = min(WIDTHS, key=lambda served: abs(served - width))
    values = _numbers(query, "values", len(NAMES))
    return PictureQuery(person, nearest, _camera(query), values or tuple(NEUTRAL.tolist()))


def _camera(query: QueryParams) -> Camera | None:
    eye, target, field = (_numbers(query, name, n) for name, n in (("eye", 3), ("target", 3), ("field", 1)))
    if eye is None or target is None or field is None:
        return None
    return Camera((eye[0], eye[1], eye[2]), (target[0], target[1], target[2]), field[0])


def _number(query: QueryParams, name: str) -> float | None:
    numbers = _numbers(query, name, 1)
    return None if numbers is None else numbers[0]


def _numbers(query: QueryParams, name: str, count: int) -> tuple[float, ...] | None:
    """Return the numbers, separated by commas, that a query has under a name; None if it has none."""
    text = query.get(name)
    if not text:
        return None
    try:
        numbers = tuple(float(part) for part in text.split(","))
    except ValueError:
        numbers = ()
    if len(numbers) != count or not all(-1e6 < number < 1e6 for number in numbers):
        raise InputError(f"{name} '{text[:40]}'; expected {count} numbers, separated by commas")
    return numbers


class PictureServer:
    """Draws one picture at a time for all pages. `token` is what they must send, None: nothing."""

    def __init__(self, token: str | None = None) -> None:
        self._token = token
        self._lock = threading.Lock()
        self._waiting = 0
        self._solvers = SolverCache(KEPT)
        self._renderers: OrderedDict[object, SoftwareRenderer] = OrderedDict()

    def route(self) -> Route:
        """Return the route of the pictures."""
        return Route("/picture.webp", self.picture)

    async def picture(self, request: Request) -> Response:
        """Send a picture with a transparent background."""
        if self._token is not None and not has_token(request.headers, self._token):
            return PlainTextResponse("wrong token; expected that of this server, as Bearer\n", 403)
        if self._waiting >= WAITING:
            return PlainTextResponse("too many pictures are being drawn\n", 503)
        self._waiting += 1
        try:
            query = picture_query(request.query_params)
            data = await run_in_threadpool(self.drawn, query)
        except RisoriusError as error:
            return PlainTextResponse(f"{error}\n", 400)
        finally:
            self._waiting -= 1
        return Response(data, media_type="image/webp", headers={"cache-control": "no-store"})

    def drawn(self, query: PictureQuery) -> bytes:
        """Return a picture as WebP. Raises InputError for looks that do not exist."""
        with self._lock:
            picture = self._draw(query)
        file = io.BytesIO()
        Image.fromarray(picture).save(file, "WEBP", quality=QUALITY, method=0)
        return file.getvalue()

    def _draw(self, query: PictureQuery) -> ByteArray:
        solver = self._solvers.shared(Settings(head=query.person.head, age=query.person.age))
        key = query.person, query.width
        renderer = _cached(self._renderers, key, lambda: _renderer(solver, query))
        renderer.look_from(query.camera or frame_head(renderer.scene.anatomy, query.width / HEIGHT))
        return renderer.render(solver.solve(np.clip(query.values, _LOWEST, _HIGHEST)))


def _renderer(solver: FaceSolver, query: PictureQuery) -> SoftwareRenderer:
    look = Look(hair=query.person.hair, complexion=query.person.complexion)
    model = head_model(solver.head, apply_look(solver.head.identity.looks, look))
    return SoftwareRenderer(model, (query.width, HEIGHT), "draft", alpha=True)


def _cached(cache: OrderedDict[K, V], key: K, make: Callable[[], V]) -> V:
    """Return what is kept under a key; make it if it is missing, and drop what was used longest ago."""
    if key not in cache:
        cache[key] = make()
    cache.move_to_end(key)
    while len(cache) > KEPT:
        cache.popitem(last=False)
    return cache[key]
