"""What a thread warns of, collected; threads that collect at the same time do not disturb each other."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ..errors import RisoriusWarning

_lock = threading.Lock()
_collecting: dict[int, list[str]] = {}
_outer: Any = None


@contextmanager
def collected() -> Iterator[list[str]]:
    """Yield a list that fills with what the library warns of in this thread, a line each."""
    found: list[str] = []
    _begin(found)
    try:
        yield found
    finally:
        _end()


def _begin(found: list[str]) -> None:
    """Collect for this thread; the first one to do so changes how the process shows warnings."""
    global _outer
    with _lock:
        if not _collecting:
            _outer = warnings.catch_warnings()
            _outer.__enter__()
            shown = warnings.showwarning
            warnings.simplefilter("always", RisoriusWarning)

            def show(message: Any, category: type[Warning], *rest: Any, **more: Any) -> None:
                mine = _collecting.get(threading.get_ident())
                if mine is None or not issubclass(category, RisoriusWarning):
                    shown(message, category, *rest, **more)
                else:
                    mine.append(" ".join(str(message).split()))

            warnings.showwarning = show
        _collecting[threading.get_ident()] = found


def _end() -> None:
    with _lock:
        del _collecting[threading.get_ident()]
        if not _collecting:
            _outer.__exit__(None, None, None)
