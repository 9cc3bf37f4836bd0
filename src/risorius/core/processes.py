"""Programs of this package that run in processes of their own, beside the one that starts them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any


def start(module: str, *arguments: str, **options: Any) -> subprocess.Popen[bytes]:
    """Start `python -m module`, which finds the same modules as this process, but none in the current folder.

    `options` are those of `subprocess.Popen`.
    """
    # Our own package may have been found in the current folder.
    paths = os.pathsep.join([*(entry for entry in sys.path if entry), str(Path(__file__).parents[2])])
    command = [sys.executable, "-P", "-m", module, *arguments]
    return subprocess.Popen(command, env={**os.environ, "PYTHONPATH": paths}, **options)
