"""`.npz` and `.vertices.npz`: everything as numpy arrays, the second with the skin of every frame.

`time_s` (frames,), `values` (frames, 46) and their `names`, `fps` as numerator and denominator, and if it
is asked for `skin` (frames, N1, 3) float32 in mm in the head frame, `skin_rest` and `skin_triangles`. The
same performance gives the same bytes. Lost: causes, for which see `.performance.json`.
"""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import numpy as np

from ...core.arrays import AnyArray
from ...core.parameters import NAMES
from ...core.performance import Performance
from ..export_source import WritableTake, WriteOptions
from ..formats import register


def write_npz(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write the curves."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        _curves(archive, take.performance)


def write_vertices_npz(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the curves, and the skin frame by frame: memory does not grow with the clip."""
    head = take.shown_head
    frames, rest = len(take.performance.values), head.skin.matrix @ head.rest
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        _curves(archive, take.performance)
        _add(archive, "skin_rest", rest.astype(np.float32))
        _add(archive, "skin_triangles", head.skin.triangles)
        header = {"descr": "<f4", "fortran_order": False, "shape": (frames, *rest.shape)}
        with archive.open(_entry("skin"), "w", force_zip64=True) as file:
            np.lib.format.write_array_header_2_0(file, header)
            for frame in take.faces(progress=options.progress):
                file.write(np.ascontiguousarray(frame.skin, "<f4").tobytes())


def _curves(archive: zipfile.ZipFile, performance: Performance) -> None:
    fps = performance.fps
    _add(archive, "time_s", performance.times)
    _add(archive, "values", performance.values)
    _add(archive, "names", np.array(NAMES))
    _add(archive, "fps", np.array([fps.numerator, fps.denominator]))


def _add(archive: zipfile.ZipFile, name: str, values: AnyArray) -> None:
    buffer = io.BytesIO()
    np.lib.format.write_array(buffer, np.asarray(values, order="C"), allow_pickle=False)
    archive.writestr(_entry(name), buffer.getvalue())


def _entry(name: str) -> zipfile.ZipInfo:
    # A fixed date, so that the bytes depend on the arrays alone.
    entry = zipfile.ZipInfo(f"{name}.npy", date_time=(1980, 1, 1, 0, 0, 0))
    entry.compress_type = zipfile.ZIP_DEFLATED
    return entry


register(".npz", "the curves as numpy arrays", {"curves"}, write_npz)
register(".vertices.npz", "the curves and the skin of every frame", {"head"}, write_vertices_npz)
