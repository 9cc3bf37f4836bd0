"""Guard the server: only a page that it sent, on this machine and within bounds, may speak to it."""

from __future__ import annotations

import hmac
from collections.abc import Iterable
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

HOSTS = ("127.0.0.1", "localhost", "[::1]")
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self' blob:; "
    "img-src 'self' blob: data:; media-src 'self' blob:; font-src 'self'; worker-src 'self' blob:; "
    "base-uri 'none'; form-action 'none'; frame-src 'self'; frame-ancestors 'self'"
)
HEADERS = (
    (b"content-security-policy", POLICY.encode()),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
)


class Guard:
    """Lets through requests that name this server as their host and come from its own page; adds headers.

    A page of another site can make a browser send requests here, but then Origin names that site; by a name
    that resolves to this machine, but then Host is that name. `hosts` None allows every host: for servers
    that ask for a token. Pages of `origins` are let through, too.
    """

    def __init__(
        self, app: ASGIApp, hosts: Iterable[str] | None = HOSTS, origins: Iterable[str] = ()
    ) -> None:
        self._app, self._origins = app, frozenset(origins)
        self._hosts = None if hosts is None else frozenset(hosts)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
        elif not self.allows(Headers(scope=scope)):
            await _refuse(scope, receive, send)
        else:
            await self._app(scope, receive, _with_headers(send))

    def allows(self, headers: Headers) -> bool:
        """Tell whether a request with these headers is from a page of ours, to a host that is known."""
        hosts = headers.getlist("host")
        if len(hosts) != 1 or (self._hosts is not None and _name(hosts[0]) not in self._hosts):
            return False
        origins = headers.getlist("origin")
        if not origins:
            # Browsers name the origin of every socket and of every request that changes something.
            return headers.get("sec-fetch-site", "same-origin") in ("same-origin", "none")
        return len(origins) == 1 and (origins[0] in self._origins or _is_of(origins[0], hosts[0]))


def _is_of(origin: str, host: str) -> bool:
    """Whether an Origin header is that of the server's own pages."""
    try:
        parts = urlsplit(origin)
    except ValueError:
        return False  # a bracket that is not closed
    return parts.scheme == "http" and parts.netloc == host


def _name(host: str) -> str:
    """Return a Host header without its port."""
    name, colon, port = host.rpartition(":")
    return name if colon and port.isdigit() else host


async def _refuse(scope: Scope, receive: Receive, send: Send) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": "not from this page"})
        return
    response = PlainTextResponse("only the page of this server may send requests\n", status_code=403)
    await response(scope, receive, send)


def _with_headers(send: Send) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            message["headers"] = [*message.get("headers", ()), *HEADERS]
        await send(message)

    return sent


def has_token(headers: Headers, token: str, message_token: str | None = None) -> bool:
    """Whether a client sends the server's token: as Bearer, or as the token of its message.

    Every comparison takes the same time, whatever the client sends.
    """
    kind, _, bearer = headers.get("authorization", "").partition(" ")
    sent = (message_token, bearer if kind.lower() == "bearer" else None)
    equal = [hmac.compare_digest((one or "").encode(), token.encode()) for one in sent]
    return any(equal)
