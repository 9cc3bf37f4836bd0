"""Named plug-ins: onset functions, conflict policies, channels, speech engines, outputs.

A plug-in is a plain function (or class) registered under the name by which users choose it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Generic, TypeVar

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

    def get(self, name: str) -> T:
        """Return the plug-in called `name`; raise ParameterError naming the nearest one if there is none."""
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
