"""`.obj`: one frame as a still mesh (Wavefront), each part a group; mm, Y up, the face looks along +Z.

The frame nearest to `--at` seconds, the middle one without it; turned as the head and the eyes are. Colours
follow the coordinates of each vertex (sRGB, 0 to 1), as many programs read them. Lost: motion, materials.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from pathlib import Path

import numpy as np

from ...core.arrays import Array
from ...face.frame import FaceFrame
from ...face.head.head import Head
from ...looks.head_model import head_model
from ...looks.parts import Part
from ...looks.root_attachment import RootedHairs
from ...looks.srgb import srgb_encode
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import write_lines
from ..video.png import frame_at

_EYES = ("eye_left", "eye_right")


def write_obj(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write one frame; raise InputError for a time outside the performance."""
    head, parts = take.shown_head, head_model(take.shown_head).parts()
    index = frame_at(take.performance, options.at)
    frame = next(islice(take.faces(progress=options.progress), index, None))
    write_lines(path, _lines(parts, placed(head, parts, frame)))


def placed(head: Head, parts: Mapping[str, Part], frame: FaceFrame) -> dict[str, Array]:
    """Return the points (n, 3) mm of every part in the world."""
    skin = frame.skin.astype(np.float64)
    points = {name: part.points for name, part in parts.items()}
    points |= {"skin": skin, "tongue": frame.tongue.astype(np.float64)}
    points["teeth_lower"] = frame.teeth_lower.astype(np.float64)
    points |= RootedHairs(head_model(head)).points(skin)
    for name, centre, turn in zip(_EYES, head.eye_centre, frame.eye_rotation, strict=True):
        points[name] = (points[name] - centre) @ turn.T + centre
    share = np.asarray(head.skin.matrix @ head.neck_weight)[:, None]
    for name, place in points.items():
        turned = (place - head.head_pivot) @ frame.head_rotation.T + head.head_pivot
        points[name] = place + (share if name == "skin" else 1.0) * (turned - place)
    return points


def _lines(parts: Mapping[str, Part], points: Mapping[str, Array]) -> Iterator[str]:
    yield "# Risorius; head: CC0 1.0"
    first = 1
    for name, part in parts.items():
        yield f"o {name}"
        colours = srgb_encode(part.colours)
        for place, colour in zip(points[name], colours, strict=True):
            yield "v {:.4f} {:.4f} {:.4f} {:.3f} {:.3f} {:.3f}".format(*place, *colour)
        for a, b, c in part.triangles + first:
            yield f"f {a} {b} {c}"
        first += len(part.points)


register(".obj", "one frame as a mesh", {"head"}, write_obj, reads=("at", "hair", "complexion"))
