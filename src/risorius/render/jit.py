"""The two ways in which the renderer compiles its functions, with the types that numba's decorators lose.

Kernels run in one Python thread only: numba's `workqueue` layer aborts the process when two enter at once.
Loops over bands have a fixed number of turns whatever the number of threads, so that the same instructions
meet the same data and the bytes do not depend on the machine's cores.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
import numpy as np

F = TypeVar("F", bound=Callable[..., Any])

f4 = np.float32
prange: type[range] = numba.prange
BANDS = 32
_SPREAD = 13  # coprime to BANDS: neighbouring turns work on distant rows, which evens out the threads

# Not the whole of fastmath: nan and infinity keep their meaning, and sums their order, since short loops over
# lamps would otherwise be turned into wide vector code that is three times as slow.
_FAST = {"contract", "arcp", "nsz", "afn"}


def device(function: F) -> F:
    """Compile a function that kernels call."""
    return cast(F, numba.njit(cache=True, _nrt=False, error_model="numpy", fastmath=_FAST)(function))


def exact(function: F) -> F:
    """Compile a function that kernels call and whose arithmetic must not be rearranged."""
    return cast(F, numba.njit(cache=True, _nrt=False, error_model="numpy")(function))


def kernel(function: F) -> F:
    """Compile a function whose `prange` loops run on all threads."""
    return cast(F, numba.njit(cache=True, parallel=True, error_model="numpy", fastmath=_FAST)(function))


def exact_kernel(function: F) -> F:
    """Compile a parallel function whose arithmetic must not be rearranged."""
    return cast(F, numba.njit(cache=True, parallel=True, error_model="numpy")(function))


@exact
def band_rows(turn: int, height: int) -> tuple[int, int]:
    """Return the first row of the band drawn in this turn (0..BANDS-1) and the row after its last."""
    band = (turn * _SPREAD) % BANDS
    return band * height // BANDS, (band + 1) * height // BANDS
