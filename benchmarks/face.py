"""How fast faces are made, without drawing: frames a second on one core, and the share of each step.

Run from the repository's root: `NUMBA_NUM_THREADS=1 OMP_NUM_THREADS=1 .venv/bin/python benchmarks/face.py`.
Targets (issue: the face): 250 frames a second at 30 fps with the skin in motion, 500 without. Times are of
the processor, so that other work on the machine counts little.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np

from risorius.api import speak
from risorius.face.motion import Motion, animate
from risorius.face.solve import FaceSolver
from risorius.take import Take

SENTENCE = "Oh, really? I like it very much. My baby brother put the map by the beam. "
REPEATS = 5
# What is timed: the name of a step, and the methods that make it.
STEPS: tuple[tuple[str, Callable[[FaceSolver], Any], str], ...] = (
    ("links", lambda s: s._links, "apply"),
    ("muscles", lambda s: s._displaced_skin, "at"),
    ("jaw", lambda s: s.jaw, "carry_skin"),
    ("lids", lambda s: s._lids[0], "close"),
    ("lips", lambda s: s._lips, "solve"),
    ("subdivision", lambda s: s._refine, "times"),
    ("eyeballs", lambda s: s._lids[0], "keep_off"),
    ("tongue", lambda s: s._tongue, "place"),
)


def seconds(work: Callable[[], object]) -> float:
    """Return the least processor time of several runs."""
    times = []
    for _ in range(REPEATS):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def shares(take: Take, solver: FaceSolver, whole: float, moving: bool) -> dict[str, float]:
    """Return seconds per frame of each step, timed as it happens within the whole."""
    spent: Counter[str] = Counter()
    undo = []

    def timed(name: str, owner: type, method: str) -> None:
        original = getattr(owner, method)

        def wrapper(*arguments: Any) -> Any:
            start = time.process_time_ns()
            result = original(*arguments)
            spent[name] += time.process_time_ns() - start
            return result

        setattr(owner, method, wrapper)
        undo.append((owner, method, original))

    if moving:
        timed("springs (steps and curves between frames)", Motion, "go_to")
    inside = ("links", "muscles") if moving else ()
    for name, part, method in STEPS:
        if name not in inside:
            timed(name, type(part(solver)), method)
    frames = sum(1 for _ in animate(take.performance, solver, moving, take._curves_between_frames))
    for owner, method, original in undo:
        setattr(owner, method, original)
    found = {name: ns / 1e9 / frames for name, ns in spent.items()}
    return {**found, "the rest": max(whole - sum(found.values()), 0.0)}


def report(take: Take, solver: FaceSolver, moving: bool) -> None:
    buffers = solver.buffers()

    def run() -> None:
        for _ in animate(take.performance, solver, moving, take._curves_between_frames, buffers=buffers):
            pass

    whole = seconds(run) / len(take.performance.values)
    print(f"{'springs' if moving else 'static'}: {1.0 / whole:.0f} frames/s, {1e3 * whole:.2f} ms a frame")
    for name, part in sorted(shares(take, solver, whole, moving).items(), key=lambda item: -item[1]):
        print(f"  {1e3 * part:6.3f} ms  {100.0 * part / whole:4.1f} %  {name}")


def main() -> None:
    take = speak(SENTENCE * 2, text=True)
    start = time.perf_counter()
    solver = FaceSolver(take.head)
    next(iter(animate(take.performance, solver)))
    print(f"first frame after {time.perf_counter() - start:.1f} s (kernels compiled or cached)")
    for moving in (True, False):
        report(take, solver, moving)
    biphasic = FaceSolver(take.head, phases="biphasic")
    next(iter(animate(take.performance, biphasic)))
    print("biphasic springs:")
    report(take, biphasic, True)
    peak = np.abs(take.performance.values).max()
    print(f"({len(take.performance.values)} frames at {take.performance.fps} fps; largest value {peak:g})")


if __name__ == "__main__":
    main()
