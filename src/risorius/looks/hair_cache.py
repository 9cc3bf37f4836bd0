"""Hairs that are grown once and then read from disk."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields
from typing import Any

import numpy as np
import numpy.typing as npt

from ..core.arrays import AnyArray
from ..machine.array_cache import cached_arrays
from .strands import Strands

_FIELDS = tuple(field.name for field in fields(Strands))


def cached_hairs(name: str, inputs: Sequence[npt.ArrayLike], grow: Callable[[], Strands]) -> Strands:
    """Return the hairs that `grow` returns from `inputs`, from disk if they grew before (`cached_arrays`)."""

    def compute() -> tuple[AnyArray, ...]:
        hairs = grow()
        return tuple(np.asarray(getattr(hairs, field)) for field in _FIELDS)

    arrays = cached_arrays(name, inputs, compute)
    columns: dict[str, Any] = {n: a if a.ndim else a.item() for n, a in zip(_FIELDS, arrays, strict=True)}
    return Strands(**columns)
