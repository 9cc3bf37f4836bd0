"""Write the golden files of the tests anew (`tests/golden`), after a change that is meant to move them.

`python tools/renew_goldens.py [NAME …]`; by default all. The commit that holds them says what moved.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parents[1]


def main(names: list[str]) -> None:
    """Write the named golden files; exit with a line for a name that does not exist."""
    sys.path.insert(0, str(ROOT))
    from tests.golden.cases import CURVES, FOLDER, PICTURES, SKINS

    known = {*CURVES, *SKINS, *PICTURES}
    if unknown := set(names) - known:
        sys.exit(f"unknown golden {sorted(unknown)[0]!r}; expected {', '.join(sorted(known))}")
    for name in names or sorted(known):
        if name in PICTURES:
            Image.fromarray(PICTURES[name]()).save(FOLDER / f"{name}.png", optimize=True)
        else:
            values = CURVES[name]().round(8) if name in CURVES else SKINS[name]()
            np.savez_compressed(FOLDER / f"{name}.npz", values=values)


if __name__ == "__main__":
    main(sys.argv[1:])
