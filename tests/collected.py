"""Many cases in one test: all of them are tried, and a failure names each that failed, and why."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import pytest

Case = Callable[[object], AbstractContextManager[None]]


@contextmanager
def all_cases() -> Iterator[Case]:
    """Yield the context of a case, by its name; fail at the end if a case did.

    with all_cases() as case:
        for row in table:
            with case(row.name):
                assert row.help
    """
    failures: list[str] = []
    tried: list[object] = []

    @contextmanager
    def case(name: object) -> Iterator[None]:
        tried.append(name)
        try:
            yield
        except (Exception, pytest.fail.Exception) as error:
            why = " ".join(f"{type(error).__name__}: {error}".split())
            failures.append(f"{name}: {_place(error)}: {why}")

    yield case
    assert tried, "no case was tried"
    if failures:
        pytest.fail(f"{len(failures)} of {len(tried)} cases failed:\n" + "\n".join(failures), pytrace=False)


def _place(error: BaseException) -> str:
    """Return file and line of the last frame in a test file, else of the last frame."""
    frames = traceback.extract_tb(error.__traceback__)
    tests = [frame for frame in frames if Path(frame.filename).name.startswith("test_")]
    last = (tests or frames)[-1]
    return f"{Path(last.filename).name}:{last.lineno}"
