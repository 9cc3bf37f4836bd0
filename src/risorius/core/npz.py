"""Archives of arrays (.npz)."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import IO

import numpy as np

from .arrays import AnyArray

_one_at_a_time = threading.Lock()


def read_arrays(file: Path | IO[bytes]) -> dict[str, AnyArray]:
    """Return all arrays by name; raise OSError, ValueError or zipfile.BadZipFile as `numpy.load` does.

    Only one thread reads at a time: numpy parses an array's header as Python source, and Python 3.11 confuses
    syntax trees that two threads parse at once ("AST constructor recursion depth mismatch").
    """
    with _one_at_a_time, np.load(file, allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}
