"""Named plug-ins: onset functions, conflict policies, channels, speech engines, outputs.

A plug-in is a plain function (or class) registered under the name by which users choose it.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from ..errors import ParameterError, unknown

T = TypeVar("T")


class Registry(Generic[T]):
    """A table from names to plug-ins of one kind, in the order of registration."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self._entries: dict[str, T] = {}

    def register(self, name: str) -> Callable[[T], T]:
        """Return a decorator that registers its argument under `name`; a name is given once."""

        def add(entry: T) -> T:
            if name in self._entries:
                raise ValueError(f"{self.kind} '{name}' is registered twice")
            self._entries[name] = entry
            return entry

        return add

    def forget(self, name: str) -> T:
        """Take out and return the plug-in called `name`; raise ParameterError as `get`."""
        entry = self.get(name)
        del self._entries[name]
        return entry

    def get(self, name: str) -> T:
        """Return the plug-in called `name`; raise ParameterError, with the nearest one, if it is unknown."""
        try:
            return self._entries[name]
        except KeyError:
            raise ParameterError(unknown(self.kind, name, self._entries)) from None

    def names(self) -> tuple[str, ...]:
        """Return all names."""
        return tuple(self._entries)

    def __contains__(self, name: object) -> bool:
        return name in self._entries

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)


@dataclass(frozen=True, slots=True)
class Registration:
    """A line `register(…)` of a module, as it is written; None stands for functions."""

    module: str
    arguments: tuple[Any, ...]
    keywords: Mapping[str, Any]


def registrations(folder: Path, package: str, literals: int) -> Iterator[Registration]:
    """Yield the lines `register(…)` that end the files of a package in a folder, without importing them.

    Keywords and the first arguments, as many as `literals`, are literals; the other arguments are functions.
    Raises ValueError for anything else.
    """
    for file in sorted(folder.rglob("*.py")):
        _, first, others = file.read_text(encoding="utf-8").partition(_REGISTER)
        if first:
            module = ".".join((package, *file.relative_to(folder).with_suffix("").parts))
            for statement in ast.parse(first + others).body:
                yield _registration(module, statement, literals)


_REGISTER = "\nregister("


def _registration(module: str, statement: ast.stmt, literals: int) -> Registration:
    match statement:
        case ast.Expr(ast.Call(ast.Name("register"), arguments, keywords)):
            options = {str(keyword.arg): ast.literal_eval(keyword.value) for keyword in keywords}
            values = [ast.literal_eval(argument) for argument in arguments[:literals]]
            return Registration(module, (*values, *[None for _ in arguments[literals:]]), options)
        case _:
            raise ValueError(f"{module}: expected nothing but register(…) after the first register(…)")
