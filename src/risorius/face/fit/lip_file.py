"""The fit of a head's lips as its folder has it (`lips.npz`), read without the head.

`tools/fit_lips.py` makes the fits of the heads that come with Risorius; for other heads the fit is made when
it is asked for, which takes seconds.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np

from ...core.lips.lip_rig import DEGREE, MEASURES, NONE, LipRig, rig_of_fit
from ..head.head_file import HeadFile
from ..head.head_folder import head_file

FILE = "lips.npz"


def load_lip_rig(name_or_path: str | Path = "standard") -> LipRig:
    """Return the fit of a head, by its name or path as `load_head` takes it; fit the head if it has none.

    Raises HeadError as `load_head`, and if the file of the fit lacks an array or holds a wrong one.
    """
    head = head_file(name_or_path)
    path = head.with_name(FILE)
    if path.is_file():
        return _read(path, path.stat().st_mtime_ns)
    from .lip_fit import fitted  # needs the whole face

    return fitted(head, head.stat().st_mtime_ns)


@lru_cache(maxsize=8)
def _read(path: Path, changed: int) -> LipRig:
    file = HeadFile.read(path)
    coefficients = file.array("coefficients", ("k", len(MEASURES)))
    terms = file.indices("terms", (len(coefficients), DEGREE), NONE + 1)
    return rig_of_fit(terms.astype(np.int64), coefficients)
