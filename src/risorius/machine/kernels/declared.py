"""The kernels and device functions that decorators have declared."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, NamedTuple

from .signature import Signature, parse

Arithmetic = Literal["exact", "sums", "fast", "fast sums"]


@dataclass(frozen=True)
class Declaration:
    """A kernel: a function, the texts of its signatures, and the arguments of its decorator."""

    function: Callable[..., Any]
    texts: tuple[str, ...]
    arithmetic: Arithmetic
    wide: bool

    @property
    def name(self) -> str:
        """Its module and function, without the package's name."""
        return f"{self.function.__module__.partition('.')[2]}.{self.function.__name__}"

    @property
    def arguments(self) -> tuple[str, ...]:
        """The names of the function's arguments."""
        code = self.function.__code__
        return code.co_varnames[: code.co_argcount]

    @cached_property
    def signatures(self) -> list[Signature]:
        """The signatures, read."""
        return [parse(text, self.function.__globals__) for text in self.texts]


class Device(NamedTuple):
    """How a device function is compiled."""

    arithmetic: Arithmetic
    inlined: bool


kernels: dict[str, Declaration] = {}
"""The kernels of all files that are imported, by their names."""
devices: dict[Callable[..., Any], Device] = {}
"""The device functions of all files that are imported."""
device_compilers: list[Callable[[Callable[..., Any], Device], Any]] = []
"""Replaces device functions as they are declared: one function in a process that compiles, else empty."""


def device_of(function: Any) -> Device | None:
    """Return how a function is compiled for kernels, or None if it is not a device function."""
    return devices.get(function) if hasattr(function, "__code__") else None
