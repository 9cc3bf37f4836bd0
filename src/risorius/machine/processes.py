"""The number of processes that can work at once."""

from __future__ import annotations

import os


def processors() -> int:
    """Return how many processors this process may use: at most RISORIUS_THREADS if that is set."""
    most = os.environ.get("RISORIUS_THREADS", "")
    return min(_processors(), int(most)) if most.isdecimal() and int(most) else _processors()


def _processors() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
