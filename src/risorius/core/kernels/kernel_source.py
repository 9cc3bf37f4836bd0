"""What a kernel is compiled from, as a digest: its source, and all that it reaches by the names in it.

Comments and empty lines do not count, nor what other functions of the same file do. Of a function written in
the compiler's intermediate language the whole file counts, and so does it of what such functions may change
without being named: how numba compiles our kernels.
"""

from __future__ import annotations

import enum
import hashlib
import linecache
from collections.abc import Callable, Iterator, Mapping
from functools import cache, lru_cache
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np
from numba import types
from numba.core.extending import _Intrinsic
from numba.core.registry import CPUDispatcher

from . import device_compiler, four, quick_types

_GENERATORS = device_compiler, four, quick_types
_PLAIN = int, float, complex, str, bytes, type(None), np.generic, types.Type


def digest(kernel: Any) -> str:
    """Return 32 hexadecimal digits that change with anything that a kernel's code is made of.

    Raises TypeError for one that reaches something whose value cannot be told.
    """
    reached: dict[str, str] = {}
    waiting = [kernel]
    while waiting:
        name, text, more = _described(waiting.pop())
        if name not in reached:
            reached[name] = text
            waiting += more
    found = hashlib.sha256(_generators().encode())
    for name in sorted(reached):
        found.update(f"{name}\0{reached[name]}\0".encode())
    return found.hexdigest()[:32]


def signature_text(kinds: tuple[Any, ...]) -> str:
    """Return the types of a kernel's arguments, with the names of the fields that tuples have."""
    return ", ".join(map(_type_text, kinds))


def _type_text(kind: Any) -> str:
    fields = getattr(kind, "fields", None)
    if fields is None:
        return str(kind)
    parts = (f"{name}: {_type_text(part)}" for name, part in zip(fields, kind.types, strict=True))
    return f"{kind.instance_class.__name__}({', '.join(parts)})"


@lru_cache(maxsize=1)
def _generators() -> str:
    return "".join(_file_text(str(module.__file__)) for module in _GENERATORS)


@cache
def _described(function: Any) -> tuple[str, str, list[Any]]:
    """Return a function's name, its text, and the functions that it reaches."""
    compiled = function if isinstance(function, CPUDispatcher) else vars(function).get("dispatcher")
    options = sorted((key, _text(value)) for key, value in compiled.targetoptions.items()) if compiled else []
    plain = getattr(function, "py_func", function)
    defaults = _text([plain.__defaults__, sorted((plain.__kwdefaults__ or {}).items())])
    texts, more = [f"{options}{defaults}{_body(plain.__code__)}"], []
    for name, value in sorted(_globals(plain).items(), key=lambda item: item[0]):
        if _is_own(value):
            more.append(value)
            texts.append(f"{name}: {_name(getattr(value, 'py_func', value))}")
        else:
            texts.append(f"{name}: {_text(value)}")
    return _name(plain), "\n".join(texts), more


def _globals(function: FunctionType) -> dict[str, Any]:
    """Return what the names in a function stand for, those after a module's dot included."""
    held = dict(zip(function.__code__.co_freevars, function.__closure__ or (), strict=True))
    found = {name: cell.cell_contents for name, cell in held.items()}
    names = set(_names(function.__code__))
    found |= {name: function.__globals__[name] for name in names if name in function.__globals__}
    for module in [value for value in found.values() if isinstance(value, ModuleType)]:
        if module.__name__.startswith("risorius."):
            found |= {f"{module.__name__}.{name}": vars(module)[name] for name in names & set(vars(module))}
    return found


def _names(code: CodeType) -> Iterator[str]:
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _names(constant)


def _is_own(value: Any) -> bool:
    """Whether numba compiles a function from our source."""
    return isinstance(value, CPUDispatcher) or (
        isinstance(value, FunctionType) and "dispatcher" in vars(value)
    )


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
    if isinstance(value, _Intrinsic):
        return _file_text(value._defn.__code__.co_filename)
    if isinstance(value, enum.EnumType):
        members: Mapping[str, enum.Enum] = value.__members__
        return str({name: member.value for name, member in members.items()})
    if isinstance(value, type | FunctionType | BuiltinFunctionType | np.ufunc):
        return f"{_name(value)}{getattr(value, '_fields', '')}"
    if isinstance(value, ModuleType):
        return value.__name__
    raise TypeError(f"{value!r}: whether this has changed cannot be told")


def _name(value: Callable[..., Any]) -> str:
    return f"{getattr(value, '__module__', '')}.{getattr(value, '__qualname__', value.__name__)}"


def _body(code: CodeType) -> str:
    """Return a function's arguments and its source from its first statement on, without comments."""
    rows = [(first, last) for first, last in _rows(code) if first > code.co_firstlineno] or list(_rows(code))
    first, last = min(first for first, _ in rows), max(last for _, last in rows)
    lines = linecache.getlines(code.co_filename)[first - 1 : last]
    return f"{code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]}\n{_without_comments(lines)}"


def _rows(code: CodeType) -> Iterator[tuple[int, int]]:
    """Yield the first and last row of everything that a function does."""
    for first, last, _, _ in code.co_positions():
        if first is not None and last is not None:
            yield first, last
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _rows(constant)


@cache
def _file_text(path: str) -> str:
    return _without_comments(linecache.getlines(path))


def _without_comments(lines: list[str]) -> str:
    kept = (line.rstrip() for line in lines)
    return "\n".join(line for line in kept if line.strip() and not line.strip().startswith("#"))
