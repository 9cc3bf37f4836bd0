"""The way the face's kernels are compiled, with the types that numba's decorators lose."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
from numba.extending import register_jitable

from ..compile_cache import use_own_folder

use_own_folder()

F = TypeVar("F", bound=Callable[..., Any])


def compiled(function: F) -> F:
    """Compile a function for one thread, kept on disk; its arithmetic is not rearranged."""
    return kernel(function)


def compiled_fast(function: F) -> F:
    """Compile a function whose sums may be rearranged into vectors."""
    return kernel(function, fastmath={"contract", "reassoc"})


def kernel(function: F, **options: Any) -> F:
    """Compile a function that Python calls, to run beside its other threads; the machine code is kept.

    `options` are numba's. There is no way in for C: nobody takes it, and the first run would wait for it.
    """
    jit = numba.njit(cache=True, nogil=True, error_model="numpy", no_cfunc_wrapper=True, **options)
    return cast(F, jit(function))


def device(function: F, **options: Any) -> F:
    """Let kernels call a function; Python calls it as it stands.

    It is compiled with the kernels that call it and kept within them, without the ways in for Python and for
    C: they would take longer to compile than most of our functions, and the first run waits for each of them.
    """
    return cast(F, register_jitable(error_model="numpy", no_cfunc_wrapper=True, **options)(function))


def inlined(function: F) -> F:
    """Compile a function into its callers: passing arrays costs more than a few sums on them."""
    return cast(F, numba.njit(inline="always", error_model="numpy")(function))
