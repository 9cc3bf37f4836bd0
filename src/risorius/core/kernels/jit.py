"""The decorators that compile functions with numba, typed so that a function keeps its signature.

Kernels are what Python calls; device functions are what kernels call. Kernels run without Python's lock and
in one thread each, so that several faces or pictures can be calculated at once, and the bytes of each do not
depend on the machine's cores. There are three arithmetics: the exact one is the default; `summing_…` may take
sums in any order; `fast_…` may replace divisions and roots by cheaper operations of nearly the same value.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba
import numpy as np

from .compile_cache import use_own_folder
from .device_compiler import KernelCompiler, register_device
from .shipped import KernelCache

use_own_folder()

F = TypeVar("F", bound=Callable[..., Any])

# numpy's types, as mypy shall see them: kernels calculate with what Python calls float and int.
f4 = cast(Callable[[float], float], np.float32)
f8 = cast(Callable[[float], float], np.float64)
i4 = cast(Callable[[float], int], np.int32)
i8 = cast(Callable[[float], int], np.int64)
# Indices without sign: numba then leaves out the test for negative ones, which counts in inner loops.
index = cast(Callable[[float], int], np.uint32)

_SUMS = {"contract", "reassoc"}
# Not the whole of fastmath: nan and infinity keep their meaning, and sums their order, since short loops over
# lamps would otherwise be turned into wide vector code that is three times as slow.
_FAST = {"contract", "arcp", "nsz", "afn"}


def kernel(function: F) -> F:
    """Compile a function that Python calls; its arithmetic is not rearranged."""
    return _kernel(function)


def summing_kernel(function: F) -> F:
    """Compile a kernel whose sums may be taken in any order, several at once."""
    return _kernel(function, fastmath=_SUMS)


def lean_kernel(function: F) -> F:
    """Compile an exact kernel that neither makes nor slices arrays, and so needs no count of references."""
    return _kernel(function, _nrt=False)


def fast_kernel(function: F) -> F:
    """Compile a lean kernel of fast arithmetic."""
    return _kernel(function, _nrt=False, fastmath=_FAST)


def device(function: F) -> F:
    """Compile a function that kernels call; its arithmetic is not rearranged.

    Python calls the function itself, not compiled.
    """
    return _device(function)


def summing_device(function: F) -> F:
    """Compile a device function whose sums may be taken in any order, several at once."""
    return _device(function, fastmath=_SUMS)


def lean_device(function: F) -> F:
    """Compile an exact device function that neither makes nor slices arrays."""
    return _device(function, _nrt=False)


def fast_device(function: F) -> F:
    """Compile a lean device function of fast arithmetic."""
    return _device(function, _nrt=False, fastmath=_FAST)


def fast_summing_device(function: F) -> F:
    """Compile a lean device function of fast arithmetic whose sums may be taken in any order."""
    return _device(function, _nrt=False, fastmath=_FAST | {"reassoc"})


def inlined(function: F) -> F:
    """Compile a function into the body of its callers, under their rules of arithmetic.

    For functions of many arrays that are called often: each array travels as seven or more numbers, and some
    hundred of them on the stack cost more than the function's own work.
    """
    return cast(F, numba.njit(inline="always", error_model="numpy")(function))


def fast_inlined(function: F) -> F:
    """Compile a function into the body of fast kernels, see `inlined`."""
    return cast(F, numba.njit(inline="always", _nrt=False, error_model="numpy", fastmath=_FAST)(function))


def _kernel(function: F, **options: Any) -> F:
    """Compile a kernel, unless the user's cache or the package has its code, and keep it in the cache.

    No entry point for C is generated: nothing uses it, and the first run would wait for its compilation.
    """
    jit = numba.njit(
        nogil=True,
        error_model="numpy",
        no_cfunc_wrapper=True,
        pipeline_class=KernelCompiler,
        **options,
    )
    dispatcher = jit(function)
    dispatcher._cache = KernelCache(function)
    return cast(F, dispatcher)


def _device(function: F, **options: Any) -> F:
    """Compile a function for kernels to call, which is stored within each of them.

    Python keeps the function itself, not compiled.
    """
    standard = {"nopython": True, "boundscheck": None, "error_model": "numpy", "fastmath": False}
    register_device(function, {**standard, **options})
    return function
