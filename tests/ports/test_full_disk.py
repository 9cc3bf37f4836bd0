"""Faults of the disk while each format is written: one line, no part of a file, the old one as it was."""

from __future__ import annotations

import resource
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from risorius.errors import OutputError
from risorius.ports.formats import FORMATS
from risorius.take import Take

from ..profiles import everyday

QUICK = (".muscles.csv", ".score.json", ".performance.json", ".TextGrid", ".wav", ".npz")
OLD = b"what was there before"


@contextmanager
def files_up_to(size: int) -> Iterator[None]:
    """Let no file of this process, or of one that it starts, grow beyond `size` bytes: EFBIG."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, before)


@pytest.mark.parametrize("suffix", everyday(FORMATS, QUICK))
def test_a_file_that_may_not_grow_is_one_line_and_leaves_nothing(
    suffix: str, clip: Take, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Python would write the bytecode of what is imported meanwhile, and leave it cut off.
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
    path = tmp_path / f"out{suffix}"
    path.write_bytes(OLD)
    with files_up_to(20), pytest.raises(OutputError, match=r"File too large|encoder"):
        clip.write(path)
    assert path.read_bytes() == OLD
    assert [left.name for left in tmp_path.iterdir()] == [path.name]
