"""How much of a performance is lost on its way out into a capture's format and in again.

    python benchmarks/captures.py [INPUT]

Per format: the distance between the skins of both, all vertices of all frames: root mean square, and what
99 % of them are within, in mm. 30 frames per second, without inertia.
"""

from __future__ import annotations

import argparse
import tempfile
from fractions import Fraction
from pathlib import Path

import numpy as np

import risorius
from risorius.ports.formats import FORMATS, Need


def main() -> None:
    """Print a line for each format."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("input", nargs="?", default="examples/demo.xml")
    asked = parser.parse_args()
    settings = risorius.Settings(dynamics="static", fps=Fraction(30))
    take = risorius.speak(asked.input, settings=settings)
    skins = [frame.skin.copy() for frame in take.faces()]
    with tempfile.TemporaryDirectory() as folder:
        for suffix in (
            s for s in FORMATS if FORMATS.get(s).read_suffixes and Need.HEAD in FORMATS.get(s).needs
        ):
            path = Path(folder) / f"x{suffix}"
            take.write(path)
            again = risorius.play(path, settings=settings)
            pairs = zip(skins, again.faces(), strict=True)
            apart = np.array([np.linalg.norm(one - other.skin, axis=1) for one, other in pairs])
            rms, most = np.sqrt((apart**2).mean()), np.percentile(apart, 99)
            print(f"{suffix:10} {rms:.2f} mm root mean square, 99 % within {most:.1f} mm")


if __name__ == "__main__":
    main()
