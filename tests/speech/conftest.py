"""A speech engine for the whole run, and workers that misbehave."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import risorius.speech.engines.worker
from risorius.core.utterance import Utterance
from risorius.speech import synthesize_line
from risorius.speech.engines.espeak import EspeakEngine

FAKE = """
import os, runpy, sys, time
from pathlib import Path

marker, mode, *rest = Path(sys.argv[1]), *sys.argv[2:]
starts = len(marker.read_text()) if marker.exists() else 0
marker.write_text("x" * (starts + 1))
if mode.endswith("_once") and starts:
    mode = "well"
if mode.startswith("deaf"):
    time.sleep(600)
if mode != "well":
    sys.stdin.readline()
if mode.startswith("die"):
    print("all is lost", file=sys.stderr)
    sys.exit(3)
if mode.startswith("hang"):
    time.sleep(600)
if mode.startswith("garbage"):
    print("what?", flush=True)
if mode.startswith("half"):
    print('{"bytes": 1000}\\\\nabc', end="", flush=True)
if mode == "well":
    worker, *folder = rest
    sys.argv = [worker, *folder]
    runpy.run_path(worker, run_name="__main__")
"""


class Misbehaving:
    """The command of a worker that misbehaves in the way of `mode`, and how often it was started."""

    def __init__(self, folder: Path, mode: str) -> None:
        program = folder / "fake_worker.py"
        program.write_text(FAKE.replace("\\\\n", "\\n"))
        self._marker = folder / "starts"
        self.command = [
            sys.executable,
            str(program),
            str(self._marker),
            mode,
            risorius.speech.engines.worker.__file__,
        ]

    @property
    def starts(self) -> int:
        return len(self._marker.read_text()) if self._marker.exists() else 0


@pytest.fixture(scope="session")
def engine() -> Iterator[EspeakEngine]:
    with EspeakEngine() as engine:
        yield engine


@pytest.fixture
def misbehaving(tmp_path: Path) -> Callable[[str], Misbehaving]:
    return lambda mode: Misbehaving(tmp_path, mode)


@pytest.fixture(scope="session")
def spoken_line() -> Utterance:
    """A line as espeak-ng says it."""
    return synthesize_line("Oh, really? My baby brother put the big map by the beam.", lead=0.3, tail=0.3)
