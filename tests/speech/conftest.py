"""A speech engine for the whole run, and workers that misbehave."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import risorius.speech.engines.worker
from risorius.core.speech.utterance import Utterance
from risorius.speech import synthesize_line
from risorius.speech.engines.espeak import EspeakEngine

FAKE = """
import importlib.util, os, sys, time
from pathlib import Path

marker, mode, worker = Path(MARKER), MODE, WORKER
starts = len(marker.read_text()) if marker.exists() else 0
marker.write_text("x" * (starts + 1))
if mode.endswith("_once") and starts:
    mode = "well"
if mode.startswith("deaf"):
    time.sleep(600)
spec = importlib.util.spec_from_file_location("worker", worker)
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)

def answer(request):
    if mode.startswith("die"):
        print("all is lost", file=sys.stderr)
        sys.exit(3)
    if mode.startswith("hang"):
        time.sleep(600)
    return module.answer(request)
"""


class Misbehaving:
    """The task of a worker that misbehaves in the way of `mode`, and how often it was started."""

    def __init__(self, folder: Path, mode: str) -> None:
        program = folder / "fake_worker.py"
        self._marker = folder / "starts"
        worker = risorius.speech.engines.worker.__file__
        names = f"MARKER, MODE, WORKER = {str(self._marker)!r}, {mode!r}, {worker!r}"
        program.write_text(names + FAKE)
        self.task = f"{program}:answer"

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
