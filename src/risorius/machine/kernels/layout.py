"""The layout of objects in memory that machine code reads, and what it needs of Python.

An array's header is PyArrayObject_fields of numpy's published C interface. It follows what begins all objects
of Python, which ends with a pointer to the object's type. A float's number is the field of PyFloatObject.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

_OBJECT = object.__basicsize__


class ObjectLayout(NamedTuple):
    """Distances in bytes from an object's address; `number` is counted from that of an array's dtype.

    So is `order`, that of the bytes of a number, which is one character.
    """

    type: int = _OBJECT - 8
    value: int = _OBJECT
    data: int = _OBJECT
    axes: int = _OBJECT + 8
    shape: int = _OBJECT + 16
    dtype: int = _OBJECT + 40
    flags: int = _OBJECT + 48
    number: int = _OBJECT + 12
    order: int = _OBJECT + 10


LAYOUT = ObjectLayout()
WELL_PLACED = 0x0101
"""The flags of arrays in C order (0x1) whose numbers are aligned (0x100)."""


class PythonTable(NamedTuple):
    """The addresses of what an entry needs of Python."""

    array: int
    real_type: int
    real_type_of_numpy: int
    short_type: int
    whole_type: int
    true: int
    false: int
    nothing: int
    refusal: int
    count_up: int
    release_lock: int
    take_lock: int
    read_whole: int
    make_whole: int
    make_real: int


REFUSED = NotImplemented
"""The result of an entry for arguments that it is not compiled for."""


def table() -> Any:
    """Return the table of this process as an array."""
    objects = (np.ndarray, float, np.float64, np.float32, int, True, False, None, REFUSED)
    functions = (
        "Py_IncRef",
        "PyEval_SaveThread",
        "PyEval_RestoreThread",
        "PyLong_AsLongLong",
        "PyLong_FromLongLong",
        "PyFloat_FromDouble",
    )
    return np.array([*map(id, objects), *map(_address, functions)], np.int64)


def _address(function: str) -> int:
    return ctypes.cast(getattr(ctypes.pythonapi, function), ctypes.c_void_p).value or 0


def check() -> None:
    """Raise RuntimeError if this Python or numpy keeps objects in another way than published."""
    array = np.zeros((2, 3), np.uint16)
    shape, described = _read(id(array) + LAYOUT.shape), _read(id(array) + LAYOUT.dtype)
    half, real, short = 0.5, np.float64(0.25), np.float32(0.125)
    matches = (
        _read(id(array) + LAYOUT.type) == id(np.ndarray),
        _read(id(array) + LAYOUT.data) == array.ctypes.data,
        _read(id(array) + LAYOUT.axes, ctypes.c_int) == array.ndim,
        (_read(shape), _read(shape + 8)) == array.shape,
        described == id(array.dtype),
        _read(described + LAYOUT.number, ctypes.c_int) == array.dtype.num,
        _read(id(array) + LAYOUT.flags, ctypes.c_int) == array.flags.num,
        _read(described + LAYOUT.order, ctypes.c_char) == array.dtype.byteorder.encode(),
        _numbers([half, real]) == [half, real],
        _read(id(short) + LAYOUT.value, ctypes.c_float) == short,
    )
    if not all(matches):
        raise RuntimeError("this Python or numpy keeps arrays in another way than Risorius was built for")


def _numbers(values: Sequence[float]) -> list[float]:
    return [_read(id(value) + LAYOUT.value, ctypes.c_double) for value in values]


def _read(address: int, kind: Any = ctypes.c_ssize_t) -> Any:
    return kind.from_address(address).value
