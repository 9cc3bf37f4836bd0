"""How fast each stage is, as a ratio to the clip's length, and how memory grows with it.

Run from the repository's root: `.venv/bin/python benchmarks/pipeline.py [planning|face|whole|memory …]`.
Targets (issue: the whole pipeline): planning 300x, face 10x, the whole video 0.7x at 720x720 and 30 fps;
a ten-minute clip under 1 GB, growing by less than 2 MB a minute.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from risorius.api import speak
from risorius.pipeline import combine, compose
from risorius.script import read_script
from risorius.settings import Settings
from risorius.speech import synthesize_script

SENTENCE = "Oh, really? I like it very much. My baby brother put the map by the beam. "
MINUTE = SENTENCE * 11
REPEATS = 5


def best(work: Callable[[], object], repeats: int = REPEATS) -> float:
    """Return the shortest of several runs, in seconds: the machine's noise only ever adds."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def planning() -> None:
    """Channels and combination, the speech being known."""
    settings = Settings()
    script = read_script(MINUTE, text=True)
    utterance = synthesize_script(script)
    seconds = best(lambda: combine(compose(script, utterance, (), settings), settings, utterance))
    print(f"planning: {utterance.duration / seconds:.0f}x real time ({utterance.duration:.0f} s of speech)")


def face() -> None:
    """Vertices of every frame, without drawing."""
    take = speak(SENTENCE * 3, text=True)
    frames = len(take.performance.values)
    next(take.faces())
    seconds = best(lambda: [None for _ in take.faces()], 3)
    print(f"face: {take.duration / seconds:.1f}x real time, {frames / seconds:.0f} frames/s")


def whole() -> None:
    """The command line from start to file, in a process of its own, after a first run."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "x.mp4"
        command = [sys.executable, "-m", "risorius", "speak", SENTENCE * 3, "-o", str(output)]
        subprocess.run(command, check=True, capture_output=True)
        duration = speak(SENTENCE * 3, text=True).duration
        seconds = best(lambda: subprocess.run(command, check=True, capture_output=True), 3)
    print(
        f"whole: {duration / seconds:.2f}x real time ({seconds:.1f} s for {duration:.1f} s, 720x720, 30 fps)"
    )


MEASURE = """
import sys
from pathlib import Path
from risorius.api import speak
take = speak(sys.argv[1], text=True)
take.write(Path(sys.argv[2]) / "x.muscles.csv")
for face in take.faces(range(0, len(take.performance.values), 60)):
    pass
# What getrusage tells begins with the memory of the process that started this one.
status = Path("/proc/self/status").read_text()
print(take.duration, status.split("VmHWM:")[1].split()[0])
"""


def memory() -> None:
    """The largest memory of the main process for clips of 2 to 20 minutes: speech, curves, faces."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for minutes in (2, 5, 10, 20):
            command = [sys.executable, "-c", MEASURE, MINUTE * minutes, folder]
            done = subprocess.run(command, check=True, capture_output=True, text=True)
            duration, kilobytes = done.stdout.split()
            found.append((float(duration) / 60, int(kilobytes) / 1024))
            print(f"memory: {found[-1][1]:.0f} MB for {found[-1][0]:.1f} minutes")
    growth = (found[-1][1] - found[0][1]) / (found[-1][0] - found[0][0])
    print(f"memory: grows by {growth:.2f} MB a minute")


ALL = {"planning": planning, "face": face, "whole": whole, "memory": memory}

if __name__ == "__main__":
    for name in sys.argv[1:] or ALL:
        ALL[name]()
    print(
        f"largest memory of this process: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB"
    )
