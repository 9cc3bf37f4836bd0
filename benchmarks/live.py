"""How soon a live face begins, and what its frames cost.

Run from the repository's root: `.venv/bin/python benchmarks/live.py`. All in one process, warm: the sentence
said first is not counted. The computing of a sentence is what its first frame costs; the other frames are
looked up.
"""

from __future__ import annotations

import resource
import statistics
import time
from itertools import islice

from risorius import Live

SENTENCES = [
    f"The quick brown fox jumps over the lazy dog, for the {n} time." for n in ("first", "next", "last")
]
IDLE_MINUTES = 10


def main() -> None:
    """Print the figures."""
    face = Live(fps=60)
    frames = face.frames()
    firsts, rest, count = [], 0.0, 0
    for sentence in ("Warm up.", *SENTENCES):
        next(frames)
        face.say(sentence)
        face.flush()
        start, computing = time.perf_counter(), time.process_time()
        frame = next(frames)
        while not frame.text:
            frame = next(frames)
        firsts.append(time.perf_counter() - start)
        own = time.process_time() - computing
        start, spoken = time.perf_counter(), 1
        while next(frames).text:
            spoken += 1
        rest, count = rest + time.perf_counter() - start, count + spoken
        after = f"first frame after {firsts[-1] * 1e3:6.0f} ms, {own * 1e3:.0f} ms of it own computing"
        print(f"{after}; the sentence lasts {spoken / 60:.2f} s")
    print(f"median of the warm ones: {statistics.median(firsts[1:]) * 1e3:.0f} ms")
    print(f"a frame that is not the first: {rest / count * 1e6:.0f} µs")
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.process_time()
    for _ in islice(frames, IDLE_MINUTES * 60 * 60):
        pass
    used = time.process_time() - start
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - memory
    share = used / IDLE_MINUTES / 60
    print(f"{IDLE_MINUTES} idle minutes at 60 fps: {share:.1%} of a core, {grown / 1024:.1f} MB more")


if __name__ == "__main__":
    main()
