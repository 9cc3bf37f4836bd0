"""The ways in which the renderer compiles its functions, with the types that numba's decorators lose.

Kernels run without Python's lock and in one thread each: several pictures are drawn at once (`crew`), each by
the same instructions whatever the number of threads, so that the bytes do not depend on the machine's cores.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
import numpy as np
from numba.extending import register_jitable

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

# Not the whole of fastmath: nan and infinity keep their meaning, and sums their order, since short loops over
# lamps would otherwise be turned into wide vector code that is three times as slow.
_FAST = {"contract", "arcp", "nsz", "afn"}


def _device(function: F, **options: Any) -> F:
    """Let kernels call a function; Python calls it as it stands.

    It is compiled with the kernels that call it and kept within them, without the ways in for Python and for
    C: they would take longer to compile than most of our functions, and the first run waits for each of them.
    """
    return cast(
        F, register_jitable(error_model="numpy", _nrt=False, no_cfunc_wrapper=True, **options)(function)
    )


def device(function: F) -> F:
    """Compile a function that kernels call."""
    return _device(function, fastmath=_FAST)


def summing(function: F) -> F:
    """Compile a device function with a long sum that may be taken in any order."""
    return _device(function, fastmath=_FAST | {"reassoc"})


def exact(function: F) -> F:
    """Compile a device function whose arithmetic must not be rearranged."""
    return _device(function)


def inlined(function: F) -> F:
    """Compile a function into the body of its callers, under their rules of arithmetic.

    For functions of many arrays that are called for every pixel: each array travels as seven or more numbers,
    and some hundred of them on the stack cost more than the function's own work.
    """
    return cast(F, numba.njit(inline="always", _nrt=False, error_model="numpy", fastmath=_FAST)(function))


def _kernel(function: F, **options: Any) -> F:
    """Compile with numba and keep the machine code on disk, without a way in for C, which nobody takes."""
    options |= {"error_model": "numpy", "_nrt": False, "no_cfunc_wrapper": True}
    return cast(F, numba.njit(cache=True, nogil=True, **options)(function))


def kernel(function: F) -> F:
    """Compile a function that Python calls, to run beside Python's other threads."""
    return _kernel(function, fastmath=_FAST)


def exact_kernel(function: F) -> F:
    """Compile a kernel whose arithmetic must not be rearranged."""
    return _kernel(function)
