"""The threads in which live faces perform and hear beside their frames."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import cache


@cache
def threads(task: str, most: int) -> ThreadPoolExecutor:
    """Return the threads of a task, at most so many: all faces share them."""
    return ThreadPoolExecutor(most, task)
