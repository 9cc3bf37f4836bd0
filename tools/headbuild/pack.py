"""Write named arrays as a `.npz` whose bytes depend on nothing but the arrays."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import numpy as np

from risorius.core.arrays import AnyArray


def quantized(field: AnyArray, smallest: float = 0.004, step: float | None = None) -> dict[str, AnyArray]:
    """Vertices, int16 values and scale of a field (n, 3) in mm, leaving out displacements below `smallest`
    mm. Values are multiples of `step` mm, the finest that fits where None; coarser ones take less room.
    """
    vertices = np.flatnonzero(np.linalg.norm(field, axis=1) >= smallest)
    scale = np.float32(step or max(float(np.abs(field).max()), 1e-6) / 32767.0)
    values = np.round(field[vertices] / float(scale)).astype(np.int16)
    return {"vertices": vertices.astype(np.uint16), "values": values, "scale": np.asarray(scale)}


NOISE = 1e-9
"""Smaller coordinates (mm), weights and masks are rounding, which differs between processors."""


def short(values: AnyArray) -> AnyArray:
    """Return the values in single precision, zero where they are below `NOISE`."""
    return np.where(np.abs(values) < NOISE, 0.0, values).astype(np.float32)


def settled(values: AnyArray) -> AnyArray:
    """The values to a nanometre (or a nanoradian): beyond that, libraries of linear algebra differ."""
    return np.round(values, 6)


def write_npz(path: Path, arrays: dict[str, AnyArray]) -> None:
    """Write `arrays` in their order, with fixed dates."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, values in arrays.items():
            buffer = io.BytesIO()
            np.lib.format.write_array(buffer, np.asarray(values, order="C"), allow_pickle=False)
            entry = zipfile.ZipInfo(f"{name}.npy", date_time=(1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, buffer.getvalue())
