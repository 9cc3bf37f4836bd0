"""Whether `risorius serve` keeps time for ten clients whose faces talk on and on.

Run from the repository's root: `.venv/bin/python benchmarks/serve.py`. A frame comes when it is due or
before; one that would come a quarter of a second later is dropped by the server.
"""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys
import time
from itertools import chain, cycle
from typing import NamedTuple

from websockets.asyncio.client import connect

from live import TALK, computing
from risorius.live.serve.frames import HEADER

CLIENTS, SECONDS, STAGGER = 10, 12.0, 0.23
PORT, LOADING = 8867, 8.0


class Received(NamedTuple):
    """What a client got: seconds by which each frame came after it was due, and how many were dropped."""

    late: list[float]
    dropped: int


def main() -> None:
    """Print the figures."""
    server = subprocess.Popen([sys.executable, "-m", "risorius", "serve", "--port", str(PORT)])
    try:
        time.sleep(LOADING)
        for form in ("binary", "json"):
            start, used = time.perf_counter(), computing(server.pid)
            received = asyncio.run(_all(form))
            share = (computing(server.pid) - used) / (time.perf_counter() - start)
            late = sorted(chain.from_iterable(one.late for one in received))
            print(
                f"{CLIENTS} clients, 30 fps with ARKit weights, {form}: {len(late)} frames came,"
                f" {sum(one.dropped for one in received)} were dropped;"
                f" at most {1e3 * late[-1]:.0f} ms after they were due, 99 % at most"
                f" {1e3 * late[round(0.99 * len(late))]:.0f} ms; {share:.0%} of a core"
            )
    finally:
        server.terminate()
        server.wait()


async def _all(form: str) -> list[Received]:
    return await asyncio.gather(*(_talk(STAGGER * k, form) for k in range(CLIENTS)))


async def _talk(wait: float, form: str) -> Received:
    """Have a face talk, after so many seconds."""
    await asyncio.sleep(wait)
    said, next_time, late, dropped = cycle(TALK.split(". ")), 1.0, [], 0
    async with connect(f"ws://127.0.0.1:{PORT}/live", max_size=None) as face:
        await face.send(json.dumps({"do": "start", "version": 1, "format": form}))
        await face.send(json.dumps({"do": "say", "text": TALK}))
        async for message in face:
            now = time.perf_counter()
            if isinstance(message, bytes):
                _, _, seconds, missed, *_ = HEADER.unpack_from(message)
            else:
                event = json.loads(message)
                if event["is"] != "frame":
                    continue
                seconds, missed = event["time"], event["dropped"]
            late.append(now - seconds)
            dropped += missed
            if seconds >= next_time:
                next_time += 1.7
                await face.send(json.dumps({"do": "say", "text": f"{next(said)}. "}))
            if seconds > SECONDS:
                break
    return Received([seconds - late[0] for seconds in late], dropped)


if __name__ == "__main__":
    main()
