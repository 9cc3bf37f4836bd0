"""The threads in which live faces perform and hear beside their frames."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import cache


@cache
def threads(task: str, most: int) -> ThreadPoolExecutor:
    """Return the pool of at most `most` threads for a task; all faces share it."""
    return ThreadPoolExecutor(most, task)
