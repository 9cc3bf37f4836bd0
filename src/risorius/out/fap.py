"""`.fap`: MPEG-4 facial animation parameters (ISO/IEC 14496-2) as text, as Greta and its family read them.

A header `2.1 name fps frames`, then two lines per frame: 68 flags, and the frame's number with a whole number
for each flag that is 1. Only low-level parameters (3 to 68) are set. Lost: cheeks, chin boss, ears, wrinkles,
fractions of a unit, and frame rates that are no whole number (rounded).
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..face.feature_points import COUNT, SHOWN, FeaturePoints
from .source import Material, WriteOptions, needed
from .table import write_lines

VERSION = "2.1"
FLAGS = " ".join("1" if number in SHOWN else "0" for number in range(1, COUNT + 1))


def write_fap(material: Material, path: Path, _options: WriteOptions) -> None:
    """Write all frames, measured on the head's feature points in its own units (FAPU)."""
    write_lines(path, _lines(material))


def _lines(material: Material) -> Iterator[str]:
    points, shown = FeaturePoints(needed(material.head)), np.array(SHOWN) - 1
    performance = material.performance
    yield f"{VERSION} risorius {round(performance.fps)} {len(performance.values)}"
    for number, frame in enumerate(material.frames()):
        values = np.round(points.values(frame)[shown]).astype(int)
        yield FLAGS
        yield f"{number} " + " ".join(map(str, values))
