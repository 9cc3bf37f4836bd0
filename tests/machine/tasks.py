"""Tasks for workers of the tests."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable

from risorius.errors import InputError, Place


def echo(*values: object) -> tuple[object, ...]:
    return values


def count(tell: Callable[[object], None], most: int) -> str:
    for number in range(most):
        tell(number)
    return "done"


def refuse() -> None:
    raise InputError("is wrong; expected better", Place("x.txt", 3))


def fail() -> None:
    print("to whoever reads it")
    raise ValueError("nobody foresaw it")


def end(code: int) -> None:
    os._exit(code)


def kill() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def hang() -> None:
    signal.pause()


def interrupted() -> str:
    os.kill(os.getpid(), signal.SIGINT)
    return "goes on"


def variables() -> dict[str, str]:
    return dict(os.environ)


def once(mark: str, way: str) -> int:
    """Fail in a `way` the first time, as a mark on disk tells."""
    if not os.path.exists(mark):  # noqa: PTH110
        open(mark, "w").close()  # noqa: PTH123
        always(way)
    return os.getpid()


def always(way: str) -> None:
    {"kill": kill, "fail": fail}[way]()
