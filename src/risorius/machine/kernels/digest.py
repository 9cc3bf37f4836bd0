"""The digest of a kernel: of its source, and of all that it reaches by the names in it.

Comments and empty lines do not count, nor what other functions of the same file do.
"""

from __future__ import annotations

import enum
import hashlib
import linecache
from collections.abc import Iterator
from functools import cache, lru_cache
from pathlib import Path
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from .declared import Declaration, device_of

_COMPILERS = "compile.py", "entry.py", "layout.py", "optimize.py"
_PLAIN = int, float, complex, str, bytes, type(None), np.generic


def digest(kernel: Declaration) -> str:
    """Return 16 hexadecimal digits that change with anything that a kernel's code is made of.

    Raises TypeError for one that reaches something whose value cannot be told.
    """
    hasher = hashlib.sha256(_compilers())
    declared = kernel.texts, kernel.arithmetic, kernel.wide
    hasher.update(f"{declared}\0{_tuples(kernel)}\0".encode())
    for name, text in sorted(reached(kernel).items()):
        hasher.update(f"{name}\0{text}\0".encode())
    return hasher.hexdigest()[:16]


def reached(kernel: Declaration) -> dict[str, str]:
    """Return the texts of a kernel's function and of all device functions that it calls, by their names."""
    texts: dict[str, str] = {}
    waiting: list[Any] = [kernel.function]
    while waiting:
        name, text, more = _described(waiting.pop())
        if name not in texts:
            texts[name] = text
            waiting += more
    return texts


def _tuples(kernel: Declaration) -> str:
    """Return the names and types of the values that a kernel takes in tuples."""
    return str([[*map(str, one.values), *one.names(kernel.arguments)] for one in kernel.signatures])


@lru_cache(maxsize=1)
def _compilers() -> bytes:
    return b"".join(Path(__file__).with_name(name).read_bytes() for name in _COMPILERS)


@cache
def _described(function: Any) -> tuple[str, str, list[Any]]:
    """Return a function's name, its text, and the functions that it reaches."""
    defaults = _text([function.__defaults__, sorted((function.__kwdefaults__ or {}).items())])
    texts, more = [f"{device_of(function)}{defaults}{_body(function.__code__)}"], []
    for name, value in sorted(_globals(function).items(), key=lambda item: item[0]):
        if device_of(value):
            more.append(value)
            texts.append(f"{name}: {_name(value)}")
        else:
            texts.append(f"{name}: {_text(value)}")
    return _name(function), "\n".join(texts), more


def _globals(function: FunctionType) -> dict[str, Any]:
    """Return what the names in a function stand for, those after a module's dot included."""
    cells = dict(zip(function.__code__.co_freevars, function.__closure__ or (), strict=True))
    values = {name: cell.cell_contents for name, cell in cells.items()}
    names = set(_names(function.__code__))
    values |= {name: function.__globals__[name] for name in names if name in function.__globals__}
    for module in [value for value in values.values() if isinstance(value, ModuleType)]:
        if module.__name__.startswith("risorius."):
            values |= {f"{module.__name__}.{name}": vars(module)[name] for name in names & set(vars(module))}
    return values


def _names(code: CodeType) -> Iterator[str]:
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _names(constant)


def _text(value: Any) -> str:
    """Return what a name stands for, as text that is the same for the same value."""
    if isinstance(value, _PLAIN):
        return f"{type(value).__name__} {value!r}"
    if isinstance(value, tuple | list):
        return f"({', '.join(map(_text, value))})"
    if isinstance(value, set | frozenset):
        return f"{{{', '.join(sorted(map(_text, value)))}}}"
    if isinstance(value, np.ndarray):
        return f"{value.dtype.str}{value.shape} {hashlib.sha256(value.tobytes()).hexdigest()}"
    if isinstance(value, enum.EnumType):
        return str({name: member.value for name, member in value.__members__.items()})  # type: ignore[var-annotated]
    if isinstance(value, type | FunctionType | BuiltinFunctionType | np.ufunc):
        return f"{_name(value)}{getattr(value, '_fields', '')}"
    if isinstance(value, ModuleType):
        return value.__name__
    raise TypeError(f"{value!r}: whether this has changed cannot be told")


def _name(value: Any) -> str:
    return f"{getattr(value, '__module__', '')}.{getattr(value, '__qualname__', value.__name__)}"


def _body(code: CodeType) -> str:
    """Return a function's arguments and its source from its first statement on, without comments."""
    rows = [(first, last) for first, last in _rows(code) if first > code.co_firstlineno] or list(_rows(code))
    first, last = min(first for first, _ in rows), max(last for _, last in rows)
    lines = linecache.getlines(code.co_filename)[first - 1 : last]
    stripped = (line.rstrip() for line in lines)
    text = "\n".join(line for line in stripped if line.strip() and not line.strip().startswith("#"))
    return f"{code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]}\n{text}"


def _rows(code: CodeType) -> Iterator[tuple[int, int]]:
    """Yield the first and last row of everything that a function does."""
    for first, last, _, _ in code.co_positions():
        if first is not None and last is not None:
            yield first, last
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _rows(constant)
