"""How many pictures a second each style, size and quality gives, drawn alone and drawn and encoded.

Run from the repository's root: `.venv/bin/python benchmarks/render.py [seconds of speech]`. Besides the time
on the clock it prints the processors' time a picture, of this process and the encoder's together, which
waiting for other work on the machine does not lengthen. Targets on two cores, drawn and encoded: realistic 25
and clay 40 pictures a second at 720x720, realistic 10 at 1080x1080.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from os import times
from pathlib import Path

from risorius.api import speak
from risorius.settings import Look, Settings
from risorius.take import Take

SENTENCE = "Oh, really? I like it very much. "
CASES = (
    ("realistic", 720, "draft"),
    ("realistic", 720, "normal"),
    ("realistic", 720, "high"),
    ("realistic", 1080, "normal"),
    ("clay", 720, "normal"),
    ("muscles", 720, "normal"),
    ("wireframe", 720, "normal"),
)


def processor_time() -> float:
    """Return the seconds that this process and those it has waited for spent on processors."""
    spent = times()
    return spent.user + spent.system + spent.children_user + spent.children_system


def measured(work: Callable[[], None], count: int) -> tuple[float, float]:
    """Return pictures a second and the processors' milliseconds a picture of `work()`."""
    clock, spent = time.perf_counter(), processor_time()
    work()
    return count / (time.perf_counter() - clock), 1000 * (processor_time() - spent) / count


def draw(take: Take) -> None:
    """Solve and draw all pictures."""
    for _ in take.pictures():
        pass


def main() -> None:
    """Print one line for each case."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 6.0
    spoken = speak(SENTENCE * max(1, round(seconds / 2.5)), text=True)
    count = len(spoken.performance.values)
    print(f"{count} pictures, drawn alone, then drawn and encoded: pictures/s (processors' ms a picture)")
    for style, side, quality in CASES:
        settings = replace(Settings(), size=(side, side), look=Look(style=style, quality=quality))
        take = replace(spoken, settings=settings)
        next(iter(take.pictures(indices=[0])))
        alone, drawing = measured(partial(draw, take), count)
        with tempfile.TemporaryDirectory() as folder:
            film = Path(folder) / "x.mp4"
            whole, spent = measured(partial(take.write, film), count)
        name = f"{style} {side}x{side} {quality}"
        print(f"{name:28s} {alone:5.1f} ({drawing:5.1f})   {whole:5.1f} ({spent:5.1f})", flush=True)


if __name__ == "__main__":
    main()
