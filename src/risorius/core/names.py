"""The names that a setting or an argument may have, with what is said of each."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any


@dataclass(frozen=True, slots=True)
class Choice:
    """A name that a setting may have, with a line on it, and the number for which it stands, if for one."""

    name: str
    description: str = ""
    number: float = 0.0


@dataclass(frozen=True, slots=True)
class Names:
    """The names that a setting may have: `known`, found at `path` ("package.module:attribute"), or both.

    At the path stands a registry, a mapping, a sequence, or a function without arguments that returns one; it
    describes the names, and may have more than are known. It is imported when the names are asked for: most
    commands need none of them.
    """

    known: tuple[str, ...] = ()
    path: str = ""

    def choices(self) -> tuple[Choice, ...]:
        """Return all names with what is said of them."""
        if not self.path:
            return tuple(map(Choice, self.known))
        table = value_at(self.path)
        table = table() if callable(table) else table
        return tuple(_choice(name, table) for name in table)


def spelled(names: Iterable[str]) -> str:
    """Return names as help lists them: "a, b or c"; each with its description, if `names` maps it to one."""
    described = names if isinstance(names, Mapping) else {}
    *first, last = [f"{name} ({described[name]})" if described.get(name) else name for name in names]
    return f"{', '.join(first)} or {last}" if first else last


def value_at(path: str) -> Any:
    """Return what stands at a path such as "core.look:COMPLEXIONS" in this package."""
    module, _, attribute = path.partition(":")
    return getattr(import_module(f"..{module}", __package__), attribute)


def _choice(name: str, table: Any) -> Choice:
    """Return a name with the description of what it stands for, or the first line of its documentation."""
    entry = table[name] if isinstance(table, Mapping) else table.get(name) if hasattr(table, "get") else None
    if isinstance(entry, float):
        return Choice(name, number=entry)
    if isinstance(entry, str):
        return Choice(name, entry)
    words = getattr(entry, "description", None) or (entry.__doc__ if callable(entry) else None) or ""
    return Choice(name, words.strip().split("\n")[0])
