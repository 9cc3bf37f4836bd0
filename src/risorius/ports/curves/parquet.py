"""`.parquet`: all curves and the ARKit weights, one row per frame, for data tools.

Needs pyarrow (the extra `data`). Column `time_s`, every parameter by its name, then `arkit_…`. Lost: causes.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.arkit import SHAPES
from ...core.parameters import NAMES
from ...errors import OutputError
from ..export_source import WritableTake, WriteOptions
from ..formats import register


def write_parquet(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the table; raise OutputError if pyarrow is not installed."""
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        raise OutputError("needs pyarrow; run pip install pyarrow") from None
    performance, track = take.performance, take.fit_arkit(options.progress)
    columns = {"time_s": performance.times}
    columns |= {name: performance.values[:, k] for k, name in enumerate(NAMES)}
    columns |= {f"arkit_{name}": track.weights[:, k] for k, name in enumerate(SHAPES)}
    table = pa.table({name: np.ascontiguousarray(values) for name, values in columns.items()})
    parquet.write_table(table, path, compression="zstd")


register(".parquet", "curves and ARKit weights for data tools", {"head"}, write_parquet)
