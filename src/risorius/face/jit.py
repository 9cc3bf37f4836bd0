"""The way the face's kernels are compiled, with the types that numba's decorators lose."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

from ..compile_cache import use_own_folder

use_own_folder()

F = TypeVar("F", bound=Callable[..., Any])


def compiled(function: F) -> F:
    """Compile a function for one thread, kept on disk; its arithmetic is not rearranged."""
    return cast(F, numba.njit(cache=True, nogil=True, error_model="numpy")(function))


def compiled_fast(function: F) -> F:
    """Compile a function whose sums may be rearranged into vectors."""
    return cast(
        F, numba.njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "reassoc"})(function)
    )


def inlined(function: F) -> F:
    """Compile a function into its callers: passing arrays costs more than a few sums on them."""
    return cast(F, numba.njit(inline="always", error_model="numpy")(function))
