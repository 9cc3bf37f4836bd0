"""Linear algebra in one thread: its sums then have one order, whatever machine and number of cores.

OpenBLAS divides a product among its threads, and rounds each part by itself; so the last bits of a result
depend on how many there are. Our products are small, and lose time by being divided.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from threadpoolctl import threadpool_limits


@contextmanager
def one_thread() -> Iterator[None]:
    """Calculate numpy's and scipy's products in one thread within the block, or the decorated function.

    The libraries' limit holds for the whole process as long as the block runs.
    """
    with threadpool_limits(1, user_api="blas"):
        yield
