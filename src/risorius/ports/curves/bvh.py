"""`.bvh`: the head's and the eyes' rotations (Biovision Hierarchy), for programs of motion capture.

Centimetres and degrees; Y up, the face looks along +Z. Channels are Zrotation Xrotation Yrotation: a point is
turned by Rz·Rx·Ry. Lost: the whole face.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...core.arrays import Array
from ...core.progress import Progress
from ...face.frame import FaceFrame
from ...face.head.head import Head
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import write_lines

_CM = 0.1
_ORDER = "Zrotation Xrotation Yrotation"


def write_bvh(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write a root at the neck's base that stays, and a head with two eyes that turn."""
    write_lines(path, _lines(take, options.progress))


def _lines(take: WritableTake, progress: Progress) -> Iterator[str]:
    performance = take.performance
    yield from _hierarchy(take.shown_head)
    yield "MOTION"
    yield f"Frames: {len(performance.values)}"
    yield f"Frame Time: {float(1 / performance.fps):.8f}"
    for frame in take.faces(progress=progress):
        yield " ".join(f"{value + 0.0:.6f}" for value in np.round(_row(frame), 6))


def _row(frame: FaceFrame) -> list[float]:
    turns = (frame.head_rotation, *frame.eye_rotation)
    return [0.0] * 6 + [angle for turn in turns for angle in euler(turn)]


def euler(rotation: Array) -> tuple[float, float, float]:
    """Return (z, x, y) in degrees with Rz·Rx·Ry = `rotation` (3, 3)."""
    x = np.arcsin(np.clip(rotation[2, 1], -1.0, 1.0))
    z = np.arctan2(-rotation[0, 1], rotation[1, 1])
    y = np.arctan2(-rotation[2, 0], rotation[2, 2])
    return float(np.degrees(z)), float(np.degrees(x)), float(np.degrees(y))


def _hierarchy(head: Head) -> Iterator[str]:
    yield "HIERARCHY"
    yield "ROOT Neck"
    yield "{"
    yield "\tOFFSET 0.0000 0.0000 0.0000"
    yield f"\tCHANNELS 6 Xposition Yposition Zposition {_ORDER}"
    yield from _joint("Head", head.head_pivot, 1, closing=False)
    for name, centre in zip(("LeftEye", "RightEye"), head.eye_centre, strict=True):
        yield from _joint(name, centre - head.head_pivot, 2)
    yield "\t}"
    yield "}"


def _joint(name: str, place: Array, depth: int, *, closing: bool = True) -> Iterator[str]:
    indent = "\t" * depth
    yield f"{indent}JOINT {name}"
    yield f"{indent}{{"
    yield f"{indent}\tOFFSET " + " ".join(f"{value * _CM:.4f}" for value in place)
    yield f"{indent}\tCHANNELS 3 {_ORDER}"
    if closing:
        yield f"{indent}\tEnd Site"
        yield f"{indent}\t{{"
        yield f"{indent}\t\tOFFSET 0.0000 0.0000 1.5000"
        yield f"{indent}\t}}"
        yield f"{indent}}}"


register(".bvh", "rotations of head and eyes", {"head"}, write_bvh)
