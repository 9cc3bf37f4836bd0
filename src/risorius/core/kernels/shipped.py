"""Kernels that come with the package, as optimized LLVM code, of which machine code is made here.

numba needs six times as long for a kernel's types, lowering and optimization as for its machine code. Code of
this file is taken where it fits: for this numba and this kind of machine, and for a kernel that has not been
changed since; whatever does not fit is compiled. `tools/build_kernels.py` writes the file.
"""

from __future__ import annotations

import io
import json
import sys
import zipfile
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import llvmlite
import llvmlite.binding as llvm
import numba
import numpy as np
from numba import _dynfunc, types
from numba.core import event
from numba.core.caching import FunctionCache
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompileResult, compile_result
from numba.core.environment import Environment
from numba.core.funcdesc import PythonFunctionDescriptor
from numba.core.registry import cpu_target
from numba.core.runtime import rtsys
from numba.core.typing import signature

from . import kernel_source

FILE = Path(__file__).with_name("kernels.zip")
INDEX = "index.json"
STORED = "risorius:kernel"
"""numba's event for each kernel that is stored in the user's cache."""
_RESULTS = types.none, types.int64, types.float64, types.float64[::1]
RESULTS = {str(kind): kind for kind in _RESULTS}
"""What kernels of the file may return."""
_DAMAGED = OSError, ValueError, KeyError, TypeError, RuntimeError, zipfile.BadZipFile


class ShippedKernel(NamedTuple):
    """A kernel for one set of types: where its code is, and what it was made of.

    `dtypes` are those of the arrays that it makes for Python.
    """

    kernel: str
    arguments: str
    source: str
    code: str
    symbol: str
    environment: str
    result: str
    dtypes: Sequence[str]


class _Contents(NamedTuple):
    """What the file holds: entries that fit this machine, and which the first picture of a kind needs."""

    entries: Mapping[tuple[str, str], ShippedKernel]
    pictures: Mapping[str, Sequence[tuple[str, str]]]


class KernelCache(FunctionCache):  # type: ignore[misc]  # numba has no types
    """The user's cache of one kernel, which is filled from the package's file if that fits."""

    def load_overload(self, sig: Any, target_context: Any) -> CompileResult | None:
        """Return the compiled kernel for some types, or None if it has to be compiled."""
        found = None
        # numba's own method first makes ready for compiling, which takes a quarter of a second; the compiler
        # does so itself.
        rtsys.initialize(target_context)
        with self._guard_against_spurious_io_errors():
            found = self._load_overload(sig, target_context)
        if found is None:
            found = load(self._py_func, sig, target_context)
            if found is not None:
                self.save_overload(sig, found)
        return found

    def save_overload(self, sig: Any, data: CompileResult) -> None:
        """Store a kernel, and tell those who count."""
        with event.trigger_event(STORED):
            super().save_overload(sig, data)


def machine() -> dict[str, Any]:
    """Return what optimized code depends on besides its source; the kind of processor is no part of it."""
    codegen = cpu_target.target_context.codegen()
    return {
        "numba": numba.__version__,
        "llvmlite": llvmlite.__version__,
        "triple": llvm.get_process_triple(),
        "layout": str(codegen.target_data),
        "offsets": dict(_dynfunc._impl_info),
        "free_threading": not getattr(sys, "_is_gil_enabled", lambda: True)(),
        "checks": bool(numba.config.BOUNDSCHECK),
    }


def name_of(function: Any) -> str:
    """Return what a kernel is called in the file."""
    return f"{function.__module__}:{function.__qualname__}"


def needed(picture: str) -> int:
    """Return how many kernels the first picture of a kind needs; 0 if that is not known."""
    return len(_contents().pictures.get(picture, ()))


def covers(picture: str) -> bool:
    """Whether the file has all kernels of a first picture as they are now, as far as they are imported."""
    contents = _contents()
    entries = [contents.entries.get(key) for key in contents.pictures.get(picture, ())]
    return bool(entries) and all(entry is not None and _is_fresh(entry) for entry in entries)


def stale() -> list[str]:
    """Return the names of the kernels that have changed since the file was written, if they are imported."""
    return sorted({entry.kernel for entry in _contents().entries.values() if not _is_fresh(entry)})


def load(function: Any, kinds: tuple[Any, ...], context: Any) -> CompileResult | None:
    """Return a kernel for some types, made of the file's code, or None if the file has none that fits."""
    try:
        entry = _contents().entries.get((name_of(function), kernel_source.signature_text(kinds)))
        if entry is None or not _is_fresh(entry):
            return None
        return _rebuilt(function, kinds, entry, _archive().read(entry.code), context)
    except _DAMAGED:
        return None


def _is_fresh(entry: ShippedKernel) -> bool:
    """Whether an entry was made of the present source; False if its kernel is gone or cannot be told."""
    module, _, function = entry.kernel.partition(":")
    if module not in sys.modules:
        return True
    try:
        return kernel_source.digest(getattr(sys.modules[module], function)) == entry.source
    except (AttributeError, TypeError, OSError):
        return False


@lru_cache(maxsize=1)
def _archive() -> zipfile.ZipFile:
    return zipfile.ZipFile(io.BytesIO(FILE.read_bytes()))


@lru_cache(maxsize=1)
def _contents() -> _Contents:
    """Return what the file holds: no entries if it is for another machine or numba, nothing if damaged."""
    try:
        found = json.loads(_archive().read(INDEX))
        entries = [ShippedKernel(**entry) for entry in found["entries"]] if found["fits"] == machine() else []
        pictures = {
            name: [(kernel, kinds) for kernel, kinds in keys] for name, keys in found["pictures"].items()
        }
        return _Contents({(entry.kernel, entry.arguments): entry for entry in entries}, pictures)
    except _DAMAGED:
        return _Contents({}, {})


def _rebuilt(
    function: Any, kinds: tuple[Any, ...], entry: ShippedKernel, code: bytes, context: Any
) -> CompileResult:
    """Make machine code, and what numba keeps of a function that it has compiled."""
    result = RESULTS[entry.result]
    arguments = function.__code__.co_varnames[: function.__code__.co_argcount]
    descriptor = PythonFunctionDescriptor(
        native=True,
        modname=function.__module__,
        qualname=function.__qualname__,
        unique_name=entry.symbol,
        doc="",
        typemap=None,
        restype=result,
        calltypes=None,
        args=arguments,
        kws=(),
        mangler=lambda *_, **__: entry.symbol,
        argtypes=tuple(kinds),
        env_name=entry.environment,
    )
    library = JITCodeLibrary(context.codegen(), entry.symbol)
    library.enable_object_caching()
    library._final_module = llvm.parse_bitcode(code)
    library._finalize_final_module()
    environment = Environment.from_fndesc(descriptor)
    environment.consts[:] = map(np.dtype, entry.dtypes)
    return compile_result(
        typing_context=context.typing_context,
        target_context=context,
        library=library,
        environment=environment,
        entry_point=context.get_executable(library, descriptor, environment),
        fndesc=descriptor,
        type_annotation="",
        signature=signature(result, *kinds),
        objectmode=False,
        lifted=(),
        reload_init=[],
        referenced_envs=(),
    )
