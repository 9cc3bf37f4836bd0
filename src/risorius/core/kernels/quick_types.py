"""Types of operations on numbers, found once: numba looks through its overloads anew for each `+`.

What it finds is remembered, and stays the same. `min` and `max` of numbers become comparisons in their
callers; numba compiles a function of each for each set of types and each kind of caller.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

from numba.core import types
from numba.core.compiler import Flags
from numba.core.imputils import lower_builtin
from numba.core.registry import cpu_target
from numba.core.types import VarArg  # type: ignore[attr-defined]
from numba.core.typing import signature
from numba.core.typing.templates import AbstractTemplate, infer_global
from numba.cpython.builtins import do_minmax

_NUMBERS = types.Number, types.Boolean


def register() -> None:
    """Let numba remember the types of operations on numbers, and compare its options quickly."""
    _register_extreme(min, operator.lt)
    _register_extreme(max, operator.gt)
    find = "get_call_type"
    setattr(types.Function, find, _remembering_operations(getattr(types.Function, find)))
    Flags.__eq__, Flags.__hash__ = _same_flags, _hash_of_flags
    context = cpu_target.typing_context
    context.resolve_function_type = _remembering_conversions(context.resolve_function_type)


def _remembering_operations(find: Callable[..., Any]) -> Callable[..., Any]:
    found: dict[Any, Any] = {}

    def get_call_type(self: Any, context: Any, args: tuple[Any, ...], kws: Mapping[str, Any]) -> Any:
        operation = self.typing_key
        if getattr(operation, "__module__", "") != "_operator" or not _are_numbers(args):
            return find(self, context, args, kws)
        known = found.get((operation, args))
        if known is None:
            known = find(self, context, args, kws)
            if self.get_impl_key(known) is operation:
                found[operation, args] = known
        else:
            # Where numba looks for the code.
            self._impl_keys[known.args] = operation
        return known

    return get_call_type


def _remembering_conversions(find: Callable[..., Any]) -> Callable[..., Any]:
    found: dict[Any, Any] = {}

    def resolve_function_type(function: Any, args: tuple[Any, ...], kws: Mapping[str, Any]) -> Any:
        if not isinstance(function, types.NumberClass) or not _are_numbers(args):
            return find(function, args, kws)
        known = found.get((function, args))
        if known is None:
            known = found[function, args] = find(function, args, kws)
        return known

    return resolve_function_type


def _same_flags(self: Any, other: Any) -> bool:
    return self is other or self._values == other._values or self.values() == other.values()


def _hash_of_flags(self: Any) -> int:
    """Return a hash of the options that were set; numba's is that of their names, the same for all."""
    options = self.options
    return hash(frozenset(name for name, value in self._values.items() if value != options[name].default))


def _are_numbers(args: tuple[Any, ...]) -> bool:
    return all(isinstance(kind, _NUMBERS) for kind in args)


def _register_extreme(function: Any, comparison: Any) -> None:
    """Let numba compile `min` or `max` of numbers within the function that calls it."""

    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return do_minmax(context, builder, sig.args, args, comparison)

    lower_builtin(function, VarArg(types.Number))(lower)
    infer_global(function)(type(f"{function.__name__}OfNumbers", (_Extreme,), {}))


class _Extreme(AbstractTemplate):  # type: ignore[misc]  # numba has no types
    metadata: ClassVar = {"target": "cpu"}  # looked at before numba's own

    def generic(self, args: tuple[Any, ...], kws: Mapping[str, Any]) -> Any:
        """Return the type of the least or greatest of at least two numbers."""
        if kws or len(args) < 2 or not all(isinstance(kind, types.Number) for kind in args):
            return None
        return signature(self.context.unify_types(*args), *args)
