"""A real server on a free port, and a client that speaks to it as the page does."""

from __future__ import annotations

import itertools
import json
import struct
import threading
import urllib.error
import urllib.request
from contextlib import contextmanager

# Loaded here: pytest rewrites them, and must not while another thread makes syntax trees (see `running`).
import hypothesis  # noqa: F401
import pytest
from websockets.sync.client import connect

from risorius.pipeline import speak
from risorius.studio import limits
from risorius.studio.session import performer
from risorius.studio.session.session import Session

from .running import running

LINE = "Oh really? I like it very much."


class Client:
    """A page: asks and waits for the answer; keeps the faces and events that come meanwhile."""

    def __init__(self, socket):
        self.socket = socket
        self.numbers = itertools.count(1)
        self.faces, self.events = [], []

    def ask(self, do, **fields):
        """Return the answer; fail where the request is refused."""
        answer = self.tried(do, **fields)
        assert "ok" in answer, answer
        return answer["ok"]

    def refused(self, do, **fields):
        """Return why a request is refused."""
        answer = self.tried(do, **fields)
        assert "error" in answer, answer
        assert "\n" not in answer["error"]
        return answer["error"]

    def tried(self, do, **fields):
        self.number = self.begin(do, **fields)
        return self.answer(self.number)

    def begin(self, do, **fields):
        """Return the number of a request that is not waited for."""
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "do": do, **fields}))
        return number

    def answer(self, number):
        while True:
            found = self.heard()
            if found is not None and found.get("re") == number and "event" not in found:
                return found

    def heard(self, timeout=120):
        """Return the next message that is JSON; faces and events are kept."""
        message = self.socket.recv(timeout)
        if isinstance(message, bytes):
            self.faces.append(message)
            return None
        found = json.loads(message)
        if "event" in found:
            self.events.append(found)
        return found

    def event(self, name):
        """Return the next event of that name."""
        while True:
            for place, found in enumerate(self.events):
                if found["event"] == name:
                    return self.events.pop(place)
            self.heard()

    def perform(self, script=LINE, **fields):
        return self.ask("perform", source={"script": script}, **fields)


def header(message):
    """Return kind, take, first frame, count, vertices and floats of pose."""
    return struct.unpack("<6I", message[:24])


class Server:
    """A server that runs, and its address."""

    def __init__(self, port, studio):
        self.address, self.studio = f"127.0.0.1:{port}", studio
        self.url = f"http://{self.address}"

    @contextmanager
    def page(self, session, **options):
        # A page that reads no more does not wait long to be said goodbye.
        options = {"max_size": None, "ping_interval": None, "close_timeout": 0.5} | options
        with connect(f"ws://{self.address}/ws/{session}", **options) as socket:
            yield Client(socket)


@contextmanager
def serving(folder):
    """Run a server in a thread."""
    with running(folder) as (studio, port):
        yield Server(port, studio)


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with serving(tmp_path_factory.mktemp("studio")) as served:
        yield served


def fetched(server, path, data=None):
    """Return status and body; a body is posted."""
    request = urllib.request.Request(server.url + path, data)
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, error.read()


class Halted:
    """Speaking that has begun and goes on when it is let."""

    def __init__(self):
        self.begun, self.go = threading.Event(), threading.Event()

    def speak(self, script, displays, settings, progress, before):
        progress("Speaking …", 2, 5)
        self.begun.set()
        assert self.go.wait(60)
        return speak(script, displays, settings, progress, None)


@pytest.fixture
def halted(monkeypatch):
    """All voices wait, once two fifths are spoken, until the test lets them go on; none speaks in advance."""
    halt = Halted()
    monkeypatch.setattr(limits, "LONGEST_PREFETCH", 0)
    monkeypatch.setattr(performer, "speak", halt.speak)
    yield halt
    halt.go.set()


@pytest.fixture
def session(tmp_path):
    return Session("one", tmp_path)
