"""A program that is killed while it writes: the old file stays, and the next run goes on."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import pytest

from risorius.ports.formats import FORMATS

RUN = "import sys; from risorius.cli import run; sys.exit(run(sys.argv[1:]))"
OLD = b"what was there before"
PATIENCE = 300.0  # s


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
