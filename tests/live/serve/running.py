"""A server of live faces in a thread beside the tests, and clients of it."""

from __future__ import annotations

import base64
import json
import struct
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import uvicorn
from websockets.sync.client import ClientConnection, connect

from risorius.core.arrays import Array
from risorius.live.serve.server import LiveServer, ServeOptions, configured, listener

from ...studio.running import parse_ahead


@dataclass
class Running:
    """A server's port, and what it holds."""

    port: int
    live: LiveServer

    @contextmanager
    def client(self, **options: Any) -> Iterator[Client]:
        """Connect."""
        settings = {"max_size": None, "ping_interval": None, "close_timeout": 0.5} | options
        with connect(f"ws://127.0.0.1:{self.port}/live", **settings) as socket:
            yield Client(socket)


@dataclass
class Client:
    """One side of a socket; `events` holds all that came but frames."""

    socket: ClientConnection
    events: list[dict[str, Any]] = field(default_factory=list)

    def send(self, do: str, **about: Any) -> None:
        self.socket.send(json.dumps({"do": do, **about}))

    def receive(self) -> Any:
        """Return the next message: an event, or a binary frame's bytes."""
        message = self.socket.recv(timeout=20)
        if isinstance(message, bytes):
            return message
        event = json.loads(message)
        if event["is"] != "frame":
            self.events.append(event)
        return event

    def start(self, **about: Any) -> Any:
        """Ask for a face, by default quickly and without weights; return the answer."""
        wanted = {"version": 1, "ahead": 2.0, "outputs": ["parameters"]} | about
        self.send("start", **wanted)
        return self.receive()

    def until(self, kind: str) -> dict[str, Any]:
        """Return the next event of a kind, which comes soon."""
        for _ in range(100):
            message = self.receive()
            if isinstance(message, dict) and message["is"] == kind:
                return message
        raise AssertionError(f"no {kind}; {self.events}")

    def frames(self) -> list[Any]:
        """Return all frames until the end."""
        frames = []
        while True:
            message = self.receive()
            if isinstance(message, dict) and message["is"] == "ended":
                return frames
            if isinstance(message, bytes) or message["is"] == "frame":
                frames.append(message)


def sound_of(frame: dict[str, Any]) -> Array:
    """Return the samples of a frame in JSON."""
    return np.frombuffer(base64.b64decode(frame["sound"]), "<i2")


def unpacked(frame: bytes) -> tuple[dict[str, Any], Array, Array]:
    """Return the header, the values and the samples of a binary frame, as docs/serve.md describes it."""
    names = ("magic", "index", "time", "dropped", "rate", "floats", "samples")
    header = dict(zip(names, struct.unpack_from("<4sIdIIII", frame), strict=True))
    values = np.frombuffer(frame, "<f4", header["floats"], 32)
    samples = np.frombuffer(frame, "<i2", header["samples"], 32 + 4 * header["floats"])
    return header, values, samples


@contextmanager
def running(**options: Any) -> Iterator[Running]:
    """Run a server."""
    parse_ahead()
    chosen = ServeOptions(port=0, **options)
    listening, live = listener(chosen), LiveServer(chosen)
    config = configured(live)
    # Pings carry random numbers, and hypothesis, at work in the tests' thread, would take them for its own.
    config.ws_ping_interval = None
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
    thread.start()
    while not server.started:
        assert thread.is_alive()
        thread.join(0.01)
    try:
        yield Running(listening.getsockname()[1], live)
    finally:
        server.should_exit = True
        thread.join(20)
        listening.close()
