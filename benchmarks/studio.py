"""How quick the studio's server is: dials, a line planned and sent, an edit, faces, a long line.

A real server and a real socket on this machine; medians, and the slowest of twenty in brackets. Run from the
repository:
    PYTHONPATH=src python benchmarks/studio.py [--minutes 5]
"""

from __future__ import annotations

import argparse
import json
import statistics
import struct
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import uvicorn
from websockets.sync.client import ClientConnection, connect

from risorius.studio.app import Studio
from risorius.studio.server import bound, configured

LINE = (
    "Oh really? I like it very much, and I would do it again tomorrow if anybody asked me to come along, "
    "but not today, because there is so much left to do before the evening."
)
TIMES = 20


class Page:
    """A page that asks and waits."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket, self._number = socket, 0
        self.faces = 0

    def ask(self, do: str, **fields: Any) -> Any:
        """Return the answer."""
        number = self.send(do, **fields)
        while True:
            message = self._socket.recv(600)
            if isinstance(message, bytes):
                self.faces += struct.unpack_from("<I", message, 12)[0]
            elif (answer := json.loads(message)).get("re") == number and "event" not in answer:
                return answer["ok"]

    def send(self, do: str, **fields: Any) -> int:
        """Send a request and return its number."""
        self._number += 1
        self._socket.send(json.dumps({"id": self._number, "do": do, **fields}))
        return self._number

    def face_of(self, number: int) -> None:
        """Wait for the first face of a dial."""
        while True:
            message = self._socket.recv(60)
            if isinstance(message, bytes) and struct.unpack_from("<2I", message) == (2, number):
                return


@contextmanager
def page() -> Iterator[Page]:
    """Serve a studio and open a page of it."""
    with tempfile.TemporaryDirectory() as folder:
        listening, studio = bound(0), Studio(Path(folder))
        server = uvicorn.Server(configured(studio))
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
        thread.start()
        while not (server.started and studio.warm.is_set()):
            time.sleep(0.05)
        with connect(f"ws://127.0.0.1:{listening.getsockname()[1]}/ws/a", max_size=None) as socket:
            yield Page(socket)
        server.should_exit = True
        thread.join()
        listening.close()


def timed(work: Callable[[int], object], times: int = TIMES) -> str:
    """Return the median and the longest time of some work in ms."""
    found = []
    for k in range(times):
        begun = time.perf_counter()
        work(k)
        found.append(1e3 * (time.perf_counter() - begun))
    return f"{statistics.median(found):.0f} ms ({max(found):.0f})"


def measure_dial(page: Page) -> None:
    page.ask("dial", values={})
    time.sleep(1.0)

    def turn(k: int) -> None:
        page.face_of(page.send("dial", values={"AU12": 0.05 * k, "AU1": 1.0 - 0.05 * k}))

    print(f"dial to the first face that moves:     {timed(turn)}")
    time.sleep(1.0)


def measure_line(page: Page, script: str, times: int = TIMES) -> None:
    begun = time.perf_counter()
    take = page.ask("perform", source={"script": script})
    spent = 1e3 * (time.perf_counter() - begun)
    print(f"{take['duration']:.1f} s: first play, voice and all:    {spent:.0f} ms")
    sent = timed(lambda k: page.ask("choose", choices={"seed": k + 1}), times)
    print(f"planned, blended and sent, voice kept: {sent}")
    take = page.ask("open")["take"]
    block = next(
        b for b in take["blocks"] if b["channel"] == "signals" and b["start"] > 0.4 * take["duration"]
    )
    at = block["start"]
    moved = timed(
        lambda k: page.ask("edit", kind="move", movement=block["id"], start=at + 0.01 * (k + 1)), times
    )
    print(f"a block moved, the change sent:        {moved}")
    print(f"undone:                                {timed(lambda k: page.ask('undo'), min(times, 5))}")
    number = page.ask("open")["take"]["take"]
    scrubbed = timed(lambda k: page.ask("face_at", take=number, time=take["duration"] * (k % 7) / 7), times)
    print(f"scrubbed to a face anywhere:           {scrubbed}")
    begun, page.faces = time.perf_counter(), 0
    page.ask("faces", take=number, first=0, last=150)
    print(f"faces streamed:                        {page.faces / (time.perf_counter() - begun):.0f} a second")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=5.0, help="length of the long line; 0 for none")
    asked = parser.parse_args()
    with page() as opened:
        measure_dial(opened)
        measure_line(opened, LINE)
        if asked.minutes:
            measure_line(opened, " ".join([LINE] * round(60 * asked.minutes / 10.5)), times=5)


if __name__ == "__main__":
    main()
