"""Machine code of kernels: finished object files, which llvmlite links with the running process.

Entries become functions of Python as those of an extension module do: by PyCFunction_NewEx.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import cache, lru_cache
from typing import Any

from .declared import Declaration
from .layout import check, table
from .store import find

KernelEntry = Callable[..., Any]
_FASTCALL = 0x0080  # METH_FASTCALL: called with a pointer to the arguments and their number


class _Method(ctypes.Structure):
    """PyMethodDef."""

    _fields_ = (
        ("name", ctypes.c_char_p),
        ("function", ctypes.c_void_p),
        ("flags", ctypes.c_int),
        ("doc", ctypes.c_char_p),
    )


@cache
def _method(name: str, address: int) -> _Method:
    """Return the description of a function. It is kept for ever, because Python refers to it."""
    return _Method(name.encode(), address, _FASTCALL, None)


def load(kernel: Declaration) -> list[KernelEntry]:
    """Return the entries of a kernel's code, one for each of its signatures."""
    return link(kernel.name, find(kernel), len(kernel.texts))


def link(name: str, code: bytes, count: int) -> list[KernelEntry]:
    """Return the entries of an object file."""
    from llvmlite import binding

    engine = _engine()
    engine.add_object_file(binding.ObjectFileRef.from_data(code))
    engine.finalize_object()
    return [_function(name, engine.get_function_address(symbol(name, number))) for number in range(count)]


def symbol(name: str, number: int) -> str:
    """Return what the entry for a kernel's signature of a number is called in its code."""
    return f"risorius.{name}.{number}"


def _function(name: str, address: int) -> KernelEntry:
    make = ctypes.pythonapi.PyCFunction_NewEx
    make.restype, make.argtypes = ctypes.py_object, (ctypes.c_void_p, ctypes.py_object, ctypes.c_void_p)
    entry: KernelEntry = make(ctypes.addressof(_method(name, address)), _table(), None)
    return entry


_table = lru_cache(maxsize=1)(table)


@lru_cache(maxsize=1)
def _engine() -> Any:
    """Return what links object files."""
    from llvmlite import binding

    check()
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    machine = binding.Target.from_default_triple().create_target_machine()
    return binding.create_mcjit_compiler(binding.parse_assembly(""), machine)
