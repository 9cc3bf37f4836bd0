"""The ways in which the renderer compiles its functions, with the types that numba's decorators lose.

Kernels run in one Python thread only: numba's `workqueue` layer aborts the process when two enter at once.
Loops over bands have a fixed number of turns whatever the number of threads, so that the same instructions
meet the same data and the bytes do not depend on the machine's cores.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
import numpy as np

from ..compile_cache import use_own_folder

use_own_folder()

F = TypeVar("F", bound=Callable[..., Any])

# numpy's types, as mypy shall see them: kernels calculate with what Python calls float and int.
f4 = cast(Callable[[float], float], np.float32)
f8 = cast(Callable[[float], float], np.float64)
i4 = cast(Callable[[float], int], np.int32)
i8 = cast(Callable[[float], int], np.int64)
# Indices without sign: numba then leaves out the test for negative ones, which counts in inner loops.
index = cast(Callable[[float], int], np.uint32)

prange: type[range] = numba.prange
BANDS = 32
_SPREAD = 13  # coprime to BANDS: neighbouring turns work on distant rows, which evens out the threads

# Not the whole of fastmath: nan and infinity keep their meaning, and sums their order, since short loops over
# lamps would otherwise be turned into wide vector code that is three times as slow.
_FAST = {"contract", "arcp", "nsz", "afn"}


def _cached(function: F, **options: Any) -> F:
    """Compile with numba and keep the machine code on disk."""
    return cast(F, numba.njit(cache=True, error_model="numpy", **options)(function))


def device(function: F) -> F:
    """Compile a function that kernels call."""
    return _cached(function, _nrt=False, fastmath=_FAST)


def exact(function: F) -> F:
    """Compile a function whose arithmetic must not be rearranged."""
    return _cached(function, _nrt=False)


def inlined(function: F) -> F:
    """Compile a function into the body of its callers, under their rules of arithmetic.

    For functions of many arrays that are called for every pixel: each array travels as seven or more numbers,
    and some hundred of them on the stack cost more than the function's own work.
    """
    return cast(F, numba.njit(inline="always", _nrt=False, error_model="numpy", fastmath=_FAST)(function))


def kernel(function: F) -> F:
    """Compile a function whose `prange` loops run on all threads."""
    return _cached(function, parallel=True, fastmath=_FAST)


def exact_kernel(function: F) -> F:
    """Compile a parallel function whose arithmetic must not be rearranged."""
    return _cached(function, parallel=True)


@exact
def band_rows(turn: int, height: int) -> tuple[int, int]:
    """Return the first row of the band drawn in this turn (0..BANDS-1) and the row after its last."""
    band = (turn * _SPREAD) % BANDS
    return band * height // BANDS, (band + 1) * height // BANDS
