"""Processes killed while they write: what was there before stays whole, and the next run goes well."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from risorius.api import load
from risorius.ports.formats import FORMATS
from risorius.settings import Settings
from risorius.take import Take

from ..profiles import everyday

OLD = b"what was there before"
RUN = "import sys; from risorius.cli import run; sys.exit(run(sys.argv[1:]))"
PATIENCE = 300.0  # s
# Of the signals that end a process at once, the one for a file that may not grow comes at a chosen byte.
PROGRAM = """
import resource, signal, sys
import risorius
performance, size, output = sys.argv[1:]
take = risorius.load(performance, settings=risorius.Settings(size=(64, 64)))
signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
resource.setrlimit(resource.RLIMIT_FSIZE, (int(size), int(size)))
take.write(output)
"""


@pytest.fixture(scope="module")
def performance(clip: Take, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A performance to write in every format."""
    path = tmp_path_factory.mktemp("given") / "x.performance.json"
    clip.write(path)
    return path


@pytest.mark.parametrize("suffix", everyday(FORMATS, (".muscles.csv",)))
@pytest.mark.parametrize("size", everyday((0, 20), (20,)))
def test_a_writer_that_is_killed_leaves_the_old_file(
    suffix: str, size: int, performance: Path, tmp_path: Path
) -> None:
    path = tmp_path / "out" / f"x{suffix}"
    path.parent.mkdir()
    path.write_bytes(OLD)
    command = [sys.executable, "-B", "-c", PROGRAM, str(performance), str(size), str(path)]
    killed = subprocess.run(command, capture_output=True, text=True)
    # Films are written by a process of their own, which tells what the signal would say.
    assert killed.returncode == -signal.SIGXFSZ or "File too large" in killed.stderr, killed.stderr
    assert path.read_bytes() == OLD
    left = [file.name for file in path.parent.iterdir() if file != path]
    assert all(name.startswith(".risorius-") and name.endswith(".part") for name in left)
    load(performance, settings=Settings(size=(64, 64))).write(path)
    assert path.stat().st_size > len(OLD)


@pytest.mark.full
@pytest.mark.parametrize("suffix", list(FORMATS))
def test_the_old_file_is_whole_after_a_kill(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"out{suffix}"
    path.write_bytes(OLD)
    command = [sys.executable, "-c", RUN, "speak", "Hello there.", "-o", str(path)]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as process:
        deadline = time.monotonic() + PATIENCE
        while not list(tmp_path.glob(".risorius-*.part")) and time.monotonic() < deadline:
            assert process.poll() is None or path.read_bytes() != OLD
            if process.poll() is not None:
                return  # it was faster than we look
        process.kill()
    assert path.read_bytes() == OLD
