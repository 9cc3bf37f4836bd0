"""The two decorators of compiled functions, typed so that a function keeps its signature.

Kernels are what Python calls; device functions are what kernels call. Their machine code is made when the
package is built (`build`), so neither numba nor a compiler is loaded here: for Python a device function stays
what it is, and a kernel loads its code at the first call. Kernels run without Python's lock and in one thread
each, so several faces or pictures can be calculated at once, and the bytes of each do not depend on the
machine's cores. A kernel raises nothing and makes no arrays.

There are four arithmetics: `exact` does each operation as it is written; `sums` may join a product and a sum
and take sums in any order; `fast` may also replace divisions and roots by cheaper operations of nearly the
same value, but keeps the order of sums; `fast sums` may take them in any.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numpy as np

from .call import Kernel
from .declared import Arithmetic, Declaration, Device, device_compilers, devices, kernels

F = TypeVar("F", bound=Callable[..., Any])

# numpy's types, as mypy shall see them: kernels calculate with what Python calls float and int.
f4 = cast(Callable[[float], float], np.float32)
f8 = cast(Callable[[float], float], np.float64)
i4 = cast(Callable[[float], int], np.int32)
i8 = cast(Callable[[float], int], np.int64)
# Indices without sign: the compiler then leaves out the test for negative ones, which counts in inner loops.
index = cast(Callable[[float], int], np.uint32)


def kernel(*signatures: str, arithmetic: Arithmetic = "exact", wide: bool = False) -> Callable[[F], F]:
    """Declare a kernel, with one or more signatures (`signature`) for the types that it takes.

    `wide`: code for processors with AVX-512 is made as well, which is worth it for long loops alone.
    """

    def decorate(function: F) -> F:
        declared = Declaration(function, signatures, arithmetic, wide)
        kernels[declared.name] = declared
        return cast(F, Kernel(declared))

    return decorate


def device(arithmetic: Arithmetic = "exact", inlined: bool = False) -> Callable[[F], F]:
    """Declare a function that kernels call; for Python it stays as it is.

    `inlined`: it becomes part of the body of its callers. Choose this for functions of many arrays that are
    called often: each array travels as seven or more numbers, and some hundred of them on the stack cost more
    than the function's own work.
    """

    def decorate(function: F) -> F:
        described = Device(arithmetic, inlined)
        devices[function] = described
        for compiler in device_compilers:
            return cast(F, compiler(function, described))
        return function

    return decorate
