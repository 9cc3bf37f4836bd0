"""Results of a stage of the pipeline, cached by its inputs."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")


class StageCache(Generic[T]):
    """The last `most` results of one stage. For one thread at a time."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._results: OrderedDict[object, T] = OrderedDict()

    def get(self, key: object, run: Callable[[], T]) -> T:
        """Return the result for `key`, all that the stage reads; call `run` if the cache lacks it."""
        if key not in self._results:
            result = run()
            while len(self._results) >= self._most:
                self._results.popitem(last=False)
            self._results[key] = result
        return self._results[key]
