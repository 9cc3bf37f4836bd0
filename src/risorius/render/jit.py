"""The ways in which the renderer compiles its functions, with the types that numba's decorators lose.

Kernels run without Python's lock and in one thread each: several pictures are drawn at once (`crew`), each by
the same instructions whatever the number of threads, so that the bytes do not depend on the machine's cores.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
import numpy as np

from ..face import jit as face_jit

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


def device(function: F) -> F:
    """Compile a function that kernels call."""
    return face_jit.device(function, _nrt=False, fastmath=_FAST)


def summing(function: F) -> F:
    """Compile a device function with a long sum that may be taken in any order."""
    return face_jit.device(function, _nrt=False, fastmath=_FAST | {"reassoc"})


def exact(function: F) -> F:
    """Compile a device function whose arithmetic must not be rearranged."""
    return face_jit.device(function, _nrt=False)


def inlined(function: F) -> F:
    """Compile a function into the body of its callers, under their rules of arithmetic.

    For functions of many arrays that are called for every pixel: each array travels as seven or more numbers,
    and some hundred of them on the stack cost more than the function's own work.
    """
    return cast(F, numba.njit(inline="always", _nrt=False, error_model="numpy", fastmath=_FAST)(function))


def kernel(function: F) -> F:
    """Compile a function that Python calls, to run beside Python's other threads."""
    return face_jit.kernel(function, _nrt=False, fastmath=_FAST)


def exact_kernel(function: F) -> F:
    """Compile a kernel whose arithmetic must not be rearranged."""
    return face_jit.kernel(function, _nrt=False)
