"""The entry of a kernel: a function of Python's C interface, called with the objects that Python has.

It is Python source, generated for a signature, which numba compiles with the kernel. It compares the types of
all values with what the kernel is compiled for, reads numbers and where the numbers of arrays lie from the
objects in memory (`layout`), and runs the kernel without Python's lock. Python's functions come in a table
(`layout.PythonTable`), so the code refers to no symbol of Python.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba
import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from .declared import Declaration
from .layout import LAYOUT, WELL_PLACED, PythonTable
from .signature import Record, Signature, Value

KINDS = types.intp(types.intp, types.intp, types.intp)
"""The types of an entry: the object with the table, a pointer to arguments and their number; a new object."""


def entry_of(kernel: Declaration, signature: Signature, compiled: Any) -> Callable[..., int]:
    """Return an entry, still to be compiled."""
    values = signature.values
    known: dict[str, Any] = {
        "kernel": compiled,
        "kinds": np.array([_kind(value) for value in values], np.int64).reshape(-1, 4 + MOST_AXES),
        "matches": _matches,
        "carray": numba.carray,
        "long": _long,
        "read_real": _real,
        "read_short": _read_short,
        "whole": _whole,
        "call": _call,
        "resume": _resume,
        "counted": _counted,
        "of_real": _of_real,
    }
    lines = ["def entry(own, arguments, count):", f"    table = long(own + {LAYOUT.data})"]
    lines += [f"    if count != {len(values)} or not matches(arguments, table, kinds):"]
    lines += [f"        return counted({_of_python('count_up')}, {_of_python('refusal')})"]
    for k, value in enumerate(values):
        lines += [f"    v{k} = long(arguments + {8 * k})", f"    n{k} = {_read(f'v{k}', value, known)}"]
    left = [f"n{k}" for k in range(len(values))]
    run = f"kernel({', '.join(_expression(kind, left, known) for kind in signature.arguments)})"
    lines += [f"    state = call({_of_python('release_lock')})"]
    lines += [f"    {'result = ' if signature.result else ''}{run}"]
    lines += [f"    resume({_of_python('take_lock')}, state)", f"    return {_returned(signature.result)}"]
    exec(compile("\n".join(lines), f"<entry of {kernel.name}>", "exec"), known)
    entry: Callable[..., int] = known["entry"]
    return entry


def _of_python(field: str) -> str:
    """Return source of an address in the table of what Python has."""
    return f"long(table + {8 * PythonTable._fields.index(field)})"


def _kind(value: Value) -> list[int]:
    """Return what `_matches` compares a value with: a class, then for arrays what their header holds."""
    if not value.shape:
        return [_class_of(value), 0, 0, 0, *[0] * MOST_AXES]
    lengths = [*value.shape, *[0] * (MOST_AXES - len(value.shape))]
    return [_ARRAY, value.dtype.num, _ORDERS[value.dtype.byteorder], len(value.shape), *lengths]


def _class_of(value: Value) -> int:
    if value.dtype.kind == "f":
        return _SHORT if value.type == "f4" else _REAL
    return _TRUTH if value.dtype.kind == "b" else _WHOLE


def _read(name: str, value: Value, known: dict[str, Any]) -> str:
    """Return source of the value of an object."""
    if value.shape:
        known[f"at_{value.type}"] = _pointer(value.dtype)
        lengths = (
            str(n) if n else f"long(long({name} + {LAYOUT.shape}) + {8 * k})"
            for k, n in enumerate(value.shape)
        )
        shape = "".join(f"{length}, " for length in lengths).replace(
            "shape", f"long({name} + {LAYOUT.shape})"
        )
        return f"carray(at_{value.type}(long({name} + {LAYOUT.data})), ({shape}))"
    known["b1" if value.dtype.kind == "b" else value.type] = value.dtype.type
    if value.type == "f4":
        return f"read_short({name}, table)"
    if value.dtype.kind == "f":
        return f"{value.type}(read_real({name} + {LAYOUT.value}))"
    if value.dtype.kind == "b":
        return f"{name} == {_of_python('true')}"
    return f"{value.type}(whole({_of_python('read_whole')}, {name}))"


def _returned(result: Value | None) -> str:
    if result is None:
        return f"counted({_of_python('count_up')}, {_of_python('nothing')})"
    if result.dtype.kind == "f":
        return f"of_real({_of_python('make_real')}, result)"
    return f"whole({_of_python('make_whole')}, result)"


def _expression(kind: Value | Record, left: list[str], known: dict[str, Any]) -> str:
    """Return source of an argument, made of the names that are left, which it takes away."""
    if isinstance(kind, Value):
        return left.pop(0)
    parts = "".join(f"{_expression(part, left, known)}, " for part in kind.parts)
    if kind.make is None:
        return f"({parts})"
    known[kind.make.__name__] = kind.make
    return f"{kind.make.__name__}({parts})"


MOST_AXES = 4
"""The largest number of axes of an array."""
_ARRAY, _REAL, _SHORT, _TRUTH, _WHOLE = range(5)
_TYPE, _VALUE, _SHAPE, _AXES = LAYOUT.type, LAYOUT.value, LAYOUT.shape, LAYOUT.axes
_DTYPE, _FLAGS, _NUMBER, _ORDER = LAYOUT.dtype, LAYOUT.flags, LAYOUT.number, LAYOUT.order
_ARRAY_TYPE, _REAL_TYPE, _NUMPY_TYPE, _SHORT_TYPE, _WHOLE_TYPE, _TRUE, _FALSE = (
    8 * PythonTable._fields.index(field)
    for field in ("array", "real_type", "real_type_of_numpy", "short_type", "whole_type", "true", "false")
)
_LONG = ir.IntType(64)
_ORDERS = {"=": ord("="), "|": ord("|")}
"""The orders of bytes: this machine's, and that of single bytes."""


def _reader(kind: Any, wanted: Any, widened: bool = False) -> Any:
    """Return a function of kernels that reads a number at an address."""

    def read(context: Any, place: Any) -> Any:
        def load(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
            found = builder.load(builder.inttoptr(arguments[0], kind.as_pointer()))
            return builder.zext(found, _LONG) if widened else found

        return wanted(types.int64), load

    return intrinsic(read)


_long = _reader(_LONG, types.int64)
_number = _reader(ir.IntType(32), types.int64, widened=True)
_real = _reader(ir.DoubleType(), types.float64)
_short = _reader(ir.FloatType(), types.float32)


def _caller(result: Any, *kinds: Any, same: bool = False) -> Any:
    """Return a function of kernels that calls the function at an address, with at most one value.

    It returns what that returns; `same`: the value instead.
    """

    def lower(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        returned = ir.VoidType() if same or result is types.void else _LONG
        kind = ir.FunctionType(returned, [argument.type for argument in arguments[1:]])
        found = builder.call(builder.inttoptr(arguments[0], kind.as_pointer()), arguments[1:])
        if same:
            return arguments[1]
        return context.get_dummy_value() if result is types.void else found

    def alone(context: Any, function: Any) -> Any:
        return result(types.int64), lower

    def of_value(context: Any, function: Any, value: Any) -> Any:
        return result(types.int64, *kinds), lower

    return intrinsic(of_value if kinds else alone)


_call = _caller(types.int64)
_whole = _caller(types.int64, types.int64)
_of_real = _caller(types.int64, types.float64)
_resume = _caller(types.void, types.int64)
_counted = _caller(types.int64, types.int64, same=True)


def _compiled(function: Callable[..., Any]) -> Any:
    """Return a function that entries call."""
    return numba.njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)


@_compiled
def _matches(arguments: int, table: int, kinds: Any) -> Any:
    """Whether the objects that a pointer points to are of the kinds (n, 4 + `MOST_AXES`)."""
    for k in range(len(kinds)):
        value = _long(arguments + 8 * k)
        type_of = _long(value + _TYPE)
        kind = kinds[k]
        if kind[0] == _ARRAY:
            if type_of != _long(table + _ARRAY_TYPE) or not _is_array(value, kind):
                return False
        elif kind[0] == _WHOLE:
            if type_of != _long(table + _WHOLE_TYPE):
                return False
        elif kind[0] == _TRUTH:
            if value != _long(table + _TRUE) and value != _long(table + _FALSE):
                return False
        elif not _is_real(type_of, table) and (kind[0] != _SHORT or type_of != _long(table + _SHORT_TYPE)):
            return False
    return True


@_compiled
def _is_real(type_of: int, table: int) -> Any:
    """Whether a type is Python's of real numbers, or numpy's of 64 bits, which derives from it."""
    return type_of == _long(table + _REAL_TYPE) or type_of == _long(table + _NUMPY_TYPE)


@_compiled
def _is_array(value: int, kind: Any) -> Any:
    """Whether an array's header is that of a kind."""
    dtype, shape = _long(value + _DTYPE), _long(value + _SHAPE)
    if _number(dtype + _NUMBER) != kind[1] or _number(dtype + _ORDER) & 0xFF != kind[2]:
        return False
    if _number(value + _AXES) != kind[3] or _number(value + _FLAGS) & WELL_PLACED != WELL_PLACED:
        return False
    for axis in range(kind[3]):
        length = kind[4 + axis]
        if length != 0 and length != _long(shape + 8 * axis):
            return False
    return True


@_compiled
def _read_short(value: int, table: int) -> Any:
    """Return a number of 32 bits, of one of numpy's or of one of Python's."""
    if _long(value + _TYPE) == _long(table + _SHORT_TYPE):
        return _short(value + _VALUE)
    return np.float32(_real(value + _VALUE))


def _pointer(dtype: np.dtype[Any]) -> Any:
    """Return a function of kernels that makes a pointer to numbers of an address."""
    pointer = types.CPointer(numba.from_dtype(dtype))

    def at(context: Any, place: Any) -> Any:
        def cast(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
            return builder.inttoptr(arguments[0], context.get_value_type(pointer))

        return pointer(types.int64), cast

    return intrinsic(at)
