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
    known: dict[str, Any] = {
        "kernel": compiled,
        "carray": numba.carray,
        "long": _long,
        "number": _number,
        "real": _real,
        "short": _short,
        "whole": _whole,
        "call": _call,
        "resume": _resume,
        "counted": _counted,
        "of_real": _of_real,
    }
    lines = ["def entry(own, arguments, count):", f"    table = long(own + {LAYOUT.data})"]
    for k, field in enumerate(PythonTable._fields):
        lines.append(f"    {field} = long(table + {8 * k})")
    values = signature.values
    lines += [f"    if count != {len(values)}:", "        return counted(count_up, refusal)"]
    for k, value in enumerate(values):
        lines.append(f"    v{k} = long(arguments + {8 * k})")
        lines += [f"    if {_differs(f'v{k}', value)}:", "        return counted(count_up, refusal)"]
    for k, value in enumerate(values):
        lines += _read(f"v{k}", value, known)
    left = [f"v{k}" for k in range(len(values))]
    run = f"kernel({', '.join(_expression(kind, left, known) for kind in signature.arguments)})"
    lines += ["    state = call(release_lock)", f"    {'result = ' if signature.result else ''}{run}"]
    lines += ["    resume(take_lock, state)", f"    return {_returned(signature.result)}"]
    exec(compile("\n".join(lines), f"<entry of {kernel.name}>", "exec"), known)
    entry: Callable[..., int] = known["entry"]
    return entry


def _differs(name: str, value: Value) -> str:
    """Return source that is true unless a value is of a type."""
    kind = f"long({name} + {LAYOUT.type})"
    if value.shape:
        order = _ORDERS[value.dtype.byteorder]
        lengths = (f" or {_length(name, k)} != {n}" for k, n in enumerate(value.shape) if n)
        return (
            f"{kind} != array or number({name} + {LAYOUT.axes}) != {len(value.shape)} "
            f"or number(long({name} + {LAYOUT.dtype}) + {LAYOUT.number}) != {value.dtype.num} "
            f"or number(long({name} + {LAYOUT.dtype}) + {LAYOUT.order}) & 0xFF != {order} "
            f"or number({name} + {LAYOUT.flags}) & {WELL_PLACED} != {WELL_PLACED}{''.join(lengths)}"
        )
    if value.dtype.kind == "f":
        short = f" and {kind} != short_type" if value.type == "f4" else ""
        return f"{kind} != real_type and {kind} != real_type_of_numpy{short}"
    return f"{name} != true and {name} != false" if value.dtype.kind == "b" else f"{kind} != whole_type"


def _length(name: str, axis: int) -> str:
    return f"long(long({name} + {LAYOUT.shape}) + {8 * axis})"


def _read(name: str, value: Value, known: dict[str, Any]) -> list[str]:
    """Return source that replaces an object by its value."""
    if value.shape:
        known[f"at_{value.type}"] = _pointer(value.dtype)
        shape = "".join(f"{n or _length(name, k)}, " for k, n in enumerate(value.shape))
        return [f"    {name} = carray(at_{value.type}(long({name} + {LAYOUT.data})), ({shape}))"]
    known["b1" if value.dtype.kind == "b" else value.type] = value.dtype.type
    if value.dtype.kind == "f":
        read = f"{value.type}(real({name} + {LAYOUT.value}))"
        if value.type == "f4":
            read = f"short({name} + {LAYOUT.value}) if long({name} + {LAYOUT.type}) == short_type else {read}"
        return [f"    n{name} = {read}"]
    if value.dtype.kind == "b":
        return [f"    n{name} = {name} == true"]
    return [f"    n{name} = {value.type}(whole(read_whole, {name}))"]


def _returned(result: Value | None) -> str:
    if result is None:
        return "counted(count_up, nothing)"
    return "of_real(make_real, result)" if result.dtype.kind == "f" else "whole(make_whole, result)"


def _expression(kind: Value | Record, left: list[str], known: dict[str, Any]) -> str:
    """Return source of an argument, made of the names that are left, which it takes away."""
    if isinstance(kind, Value):
        name = left.pop(0)
        return name if kind.shape else f"n{name}"
    parts = "".join(f"{_expression(part, left, known)}, " for part in kind.parts)
    if kind.make is None:
        return f"({parts})"
    known[kind.make.__name__] = kind.make
    return f"{kind.make.__name__}({parts})"


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


def _pointer(dtype: np.dtype[Any]) -> Any:
    """Return a function of kernels that makes a pointer to numbers of an address."""
    pointer = types.CPointer(numba.from_dtype(dtype))

    def at(context: Any, place: Any) -> Any:
        def cast(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
            return builder.inttoptr(arguments[0], context.get_value_type(pointer))

        return pointer(types.int64), cast

    return intrinsic(at)
