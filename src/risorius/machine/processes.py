"""How many processes can work at once, and programs of the package beside this one."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any


def processors() -> int:
    """Return how many processors this process may use: at most RISORIUS_THREADS if that is set."""
    most = os.environ.get("RISORIUS_THREADS", "")
    return min(_processors(), int(most)) if most.isdecimal() and int(most) else _processors()


def _processors() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def start(module: str, *arguments: str, **options: Any) -> subprocess.Popen[bytes]:
    """Start `python -m module`, which finds the same modules as this process, but none in the current folder.

    `options` are those of `subprocess.Popen`.
    """
    # Our own package may have been found in the current folder.
    paths = os.pathsep.join([*(entry for entry in sys.path if entry), str(Path(__file__).parents[2])])
    command = [sys.executable, "-P", "-m", module, *arguments]
    return subprocess.Popen(command, env={**os.environ, "PYTHONPATH": paths}, **options)
