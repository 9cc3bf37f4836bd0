"""In which order tests run, and which of them together where processes share them (`pytest -n 3`)."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import pytest
from xdist.scheduler import LoadScopeScheduling

_Entry = pytest.Item | pytest.Collector
BROWSER = "tests/studio/browser/"
FIRST = (
    BROWSER,
    "tests/test_docs.py",
    "tests/test_pipeline.py",
    "tests/face/",
    "tests/render/",
    "tests/ports/",
)
"""What takes longest, so that nothing long begins when the other process has nothing left."""
APART = ("tests/test_docs.py", "tests/blend/test_plan.py")
"""Files whose tests share nothing that takes long to prepare."""


def in_order(items: Sequence[pytest.Item]) -> list[pytest.Item]:
    """Return the tests as they are to run: those of `FIRST`, then the others by the names of their files."""

    def place(item: pytest.Item) -> tuple[int, Path]:
        group = next((k for k, start in enumerate(FIRST) if item.nodeid.startswith(start)), len(FIRST))
        return group, item.path

    return sorted(items, key=place)


def begun_elsewhere(entries: Sequence[_Entry]) -> list[_Entry]:
    """Return a folder's entries, which each process begins at another place.

    All processes read all files; what the first makes of one (pytest rewrites its assertions) is kept for the
    others.
    """
    number = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
    start = len(entries) * number // int(os.environ.get("PYTEST_XDIST_WORKER_COUNT", "1"))
    return [*entries[start:], *entries[:start]]


class FilesInOrder(LoadScopeScheduling):  # type: ignore[misc]
    """Hands out the tests of one file together, since they share what took long to prepare, in their order.

    The tests of the studio's page all go to one process, which has the browser; those of `APART` go one by
    one.
    """

    def __init__(self, config: pytest.Config, log: object) -> None:
        config.option.loadscopereorder = False
        super().__init__(config, log)

    def _split_scope(self, nodeid: str) -> str:
        file = nodeid.partition("::")[0]
        return BROWSER if file.startswith(BROWSER) else nodeid if file in APART else file
