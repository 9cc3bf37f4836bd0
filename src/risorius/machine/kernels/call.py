"""Kernels as Python calls them, and what becomes of arguments that they are not compiled for."""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from .declared import Declaration
from .layout import REFUSED
from .object_code import KernelEntry, load
from .signature import Record, Signature, Value

_loading = threading.Lock()


class Kernel:
    """A function that runs as machine code, which the first call loads."""

    def __init__(self, declared: Declaration) -> None:
        functools.update_wrapper(self, declared.function)
        self.declared = declared
        self._run: Callable[..., Any] = self._first
        self._others: list[KernelEntry] = []
        self._is_loaded = False

    def __call__(self, *arguments: Any) -> Any:
        """Run; raise TypeError for arguments that it is not declared for."""
        result = self._run(*arguments)
        return result if result is not REFUSED else self._retry(arguments)

    def _first(self, *arguments: Any) -> Any:
        """Load the code, once for all threads, and run it."""
        with _loading:
            if not self._is_loaded:
                signatures, entries = self.declared.signatures, load(self.declared)
                self._run, *self._others = map(_taking_tuples, signatures, entries)
                self._is_loaded = True
        return self._run(*arguments)

    def _retry(self, arguments: Sequence[Any]) -> Any:
        """Try other signatures, then plain arrays and numbers in place of numpy's own types; else refuse."""
        for values in (arguments, _converted(self.declared, arguments)):
            for run in (self._run, *self._others):
                result = run(*values)
                if result is not REFUSED:
                    return result
        raise TypeError(fault(self.declared, arguments))


def _taking_tuples(signature: Signature, entry: KernelEntry) -> KernelEntry:
    """Return an entry that takes tuples as a signature has them: their values go to the code one by one."""
    if signature.is_flat:
        return entry
    names = [f"a{k}" for k in range(len(signature.arguments))]
    values = (
        part for kind, name in zip(signature.arguments, names, strict=True) for part in _spread(kind, name)
    )
    call = eval(f"lambda entry, {', '.join(names)}: entry({', '.join(values)})")

    def run(*arguments: Any) -> Any:
        try:
            return call(entry, *arguments)
        except (TypeError, IndexError):  # other arguments, or some that are no tuples
            return REFUSED

    return run


def _spread(kind: Value | Record, source: str) -> Iterator[str]:
    """Yield source of the values of an argument, whose own source is given."""
    if isinstance(kind, Value):
        yield source
    elif kind.is_flat:
        yield f"*{source}"
    else:
        for k, part in enumerate(kind.parts):
            yield from _spread(part, f"{source}[{k}]")


def _converted(kernel: Declaration, arguments: Sequence[Any]) -> list[Any]:
    """Return arguments with arrays as numpy's own, and numbers as Python's, of the kind that is declared."""
    kinds = kernel.signatures[0].arguments
    if len(kinds) != len(arguments):
        return list(arguments)
    return [
        _plain(argument, getattr(kind, "type", "")) for argument, kind in zip(arguments, kinds, strict=True)
    ]


def _plain(argument: Any, kind: str) -> Any:
    if isinstance(argument, np.ndarray):
        return argument.view(np.ndarray)
    if isinstance(argument, tuple):
        parts = [_plain(part, "") for part in argument]
        return type(argument)(*parts) if hasattr(argument, "_fields") else tuple(parts)
    if isinstance(argument, np.generic):
        argument = argument.item()
    return float(argument) if kind.startswith("f") and isinstance(argument, int) else argument


def fault(kernel: Declaration, arguments: Sequence[Any]) -> str:
    """Return which argument is of another type than declared; of several signatures the last counts."""
    signature, names = kernel.signatures[-1], kernel.arguments
    if len(arguments) != len(names):
        return f"{kernel.name} takes {len(names)} arguments ({', '.join(names)}), not {len(arguments)}"
    flat = signature.flatten(arguments)
    if flat is None:
        return f"{kernel.name} takes ({', '.join(names)}), with tuples of as many values as declared"
    for name, kind, value in zip(signature.names(names), signature.values, flat, strict=True):
        if not kind.takes(value):
            return f"{kernel.name}: '{name}' is {_described(value)}; it must be {kind}"
    return f"{kernel.name} takes ({', '.join(names)}) as {'; '.join(kernel.texts)}"


def _described(value: Any) -> str:
    if not isinstance(value, np.ndarray):
        return f"of the type {type(value).__name__}"
    order = "" if value.flags.c_contiguous else ", not in C order"
    return f"an array of {value.dtype} of the shape {value.shape}{order}"
