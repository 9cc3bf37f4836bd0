"""A performance as a table of pandas."""

from __future__ import annotations

from typing import Any

from ..core.parameters import NAMES
from ..core.performance import Performance
from ..machine.optional import optional


def data_frame(performance: Performance) -> Any:
    """Return a `pandas.DataFrame`: a row a frame, indexed by `time_s`, and a column for each parameter.

    Raises RisoriusError if pandas is not installed.
    """
    pandas = optional("pandas", "pandas")
    times = pandas.Index(performance.times, name="time_s")
    return pandas.DataFrame(performance.values.copy(), index=times, columns=list(NAMES))
