"""Work on threads for the event loop."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import Executor
from typing import TypeVar

T = TypeVar("T")


async def on_thread(threads: Executor, work: Callable[[], T]) -> T:
    """Return the result of `work` on a thread; when cancelled, only after the thread has let go of it.

    Else a solver would be lent to the next while the thread still works with it.
    """
    future = asyncio.get_running_loop().run_in_executor(threads, work)
    try:
        return await asyncio.shield(future)
    except asyncio.CancelledError:
        await asyncio.wait([future])
        raise
