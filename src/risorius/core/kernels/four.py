"""Four numbers in one vector register, for use within kernels.

Written in the compiler's intermediate language, because the compiler joins operations on neighbouring numbers
only where it can prove that no two arrays overlap. A `Four` has the operators +, −, ·, / with another one or
with a single number; a product and the sum after it may become one operation.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, cast

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.datamodel import PrimitiveModel, register_default
from numba.core.imputils import lower_builtin
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic
from numba.np.arrayobj import make_array

Four = Any
"""The type, as mypy shall see it."""

LANES = 4
EVERY_LANE = 15
"""All lanes, as the bits of an integer."""
_VECTOR = ir.VectorType(ir.DoubleType(), LANES)
_LONGS = ir.VectorType(ir.IntType(64), LANES)
_in_kernels = cast(Callable[[Callable[..., Any]], Any], intrinsic)


class _FourType(types.Type):  # type: ignore[misc]  # numba has no types
    def __init__(self) -> None:
        super().__init__("four")


_four = _FourType()


@register_default(_FourType)
class _FourModel(PrimitiveModel):  # type: ignore[misc]
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _VECTOR)


def _operator(operation: Any, instruction: str) -> None:
    """Give an operation to Four and Four, and to Four and a number on either side."""
    kinds = ((_four, _four), (_four, types.float64), (types.float64, _four))

    class _Typing(ConcreteTemplate):  # type: ignore[misc]
        key = operation
        cases = tuple(signature(_four, *pair) for pair in kinds)

    def lower(context: Any, builder: ir.IRBuilder, sig: Any, arguments: Any) -> Any:
        values = [_wide(builder, value) for value in arguments]
        return getattr(builder, instruction)(*values, flags=("contract",))

    infer_global(operation)(_Typing)
    for pair in kinds:
        lower_builtin(operation, *pair)(lower)


for _operation, _instruction in (
    (operator.add, "fadd"),
    (operator.sub, "fsub"),
    (operator.mul, "fmul"),
    (operator.truediv, "fdiv"),
):
    _operator(_operation, _instruction)
    if _operation is not operator.truediv:
        _operator(getattr(operator, f"i{_operation.__name__}"), _instruction)


@_in_kernels
def four(context: Any, number: Any) -> Any:
    """Return four times the same number."""
    return _four(types.float64), lambda _, builder, __, values: _wide(builder, values[0])


@_in_kernels
def row(context: Any, array: Any, i: Any) -> Any:
    """Return row i of a contiguous array of rows of four numbers, whatever its axes."""
    return _four(array, types.int64), _row


@_in_kernels
def set_row(context: Any, array: Any, i: Any, value: Any) -> Any:
    """Write `value` to row i of such an array."""
    return types.void(array, types.int64, _four), _set_row


@_in_kernels
def four_at(context: Any, array: Any, i: Any) -> Any:
    """Return the numbers i to i + 3 of a contiguous array, counted through all its axes."""
    return _four(array, types.int64), _four_at


@_in_kernels
def root(context: Any, value: Any) -> Any:
    """Return the square roots."""
    return _four(_four), lambda _, builder, __, values: _call(builder, "sqrt", values)


@_in_kernels
def larger(context: Any, a: Any, b: Any) -> Any:
    """Return the larger of a and b in each lane."""
    return _four(_four, _four), lambda _, builder, __, values: builder.select(
        builder.fcmp_ordered(">", *values), *values
    )


@_in_kernels
def where_above(context: Any, value: Any, limit: Any, chosen: Any, other: Any) -> Any:
    """Return `chosen` in the lanes in which `value` is above the number `limit`, else `other`."""
    return _four(_four, types.float64, _four, _four), _where_above


@_in_kernels
def any_above(context: Any, value: Any, limit: Any) -> Any:
    """Return whether `value` is above the number `limit` in any lane."""
    return types.boolean(_four, types.float64), _any_above


@_in_kernels
def lanes_above(context: Any, value: Any, limit: Any) -> Any:
    """Return the lanes in which `value` is above the number `limit`, as the bits of an integer."""
    return types.int64(_four, types.float64), _lanes_above


@_in_kernels
def with_third_of_bits(context: Any, value: Any, start: Any) -> Any:
    """Return the numbers whose bits are `start` less a third of those of `value`, which is positive.

    Of these only the upper half counts.
    """
    return _four(_four, types.int64), _with_third_of_bits


def _row(context: Any, builder: ir.IRBuilder, kind: Any, values: Any) -> Any:
    return builder.load(_place(context, builder, kind, values), align=8)


def _four_at(context: Any, builder: ir.IRBuilder, kind: Any, values: Any) -> Any:
    return builder.load(_place(context, builder, kind, values, 1), align=8)


def _set_row(context: Any, builder: ir.IRBuilder, kind: Any, values: Any) -> Any:
    builder.store(values[2], _place(context, builder, kind, values), align=8)
    return context.get_dummy_value()


def _place(context: Any, builder: ir.IRBuilder, kind: Any, values: Any, step: int = LANES) -> Any:
    data = make_array(kind.args[0])(context, builder, values[0]).data
    start = builder.gep(data, [builder.mul(values[1], ir.Constant(values[1].type, step))])
    return builder.bitcast(start, _VECTOR.as_pointer())


def _call(builder: ir.IRBuilder, name: str, values: Any) -> Any:
    kind = ir.FunctionType(_VECTOR, [_VECTOR])
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v4f64"), values)


def _where_above(context: Any, builder: ir.IRBuilder, kind: Any, values: Any) -> Any:
    value, limit, chosen, other = values
    return builder.select(builder.fcmp_ordered(">", value, _wide(builder, limit)), chosen, other)


def _any_above(context: Any, builder: ir.IRBuilder, kind: Any, values: Any) -> Any:
    return builder.icmp_unsigned("!=", _bits_above(builder, values), ir.IntType(LANES)(0))


def _lanes_above(context: Any, builder: ir.IRBuilder, kind: Any, values: Any) -> Any:
    return builder.zext(_bits_above(builder, values), ir.IntType(64))


def _bits_above(builder: ir.IRBuilder, values: Any) -> Any:
    above = builder.fcmp_ordered(">", values[0], _wide(builder, values[1]))
    return builder.bitcast(above, ir.IntType(LANES))


def _with_third_of_bits(context: Any, builder: ir.IRBuilder, kind: Any, values: Any) -> Any:
    value, start = values
    half = ir.Constant(_LONGS, [32] * LANES)
    upper = builder.lshr(builder.bitcast(value, _LONGS), half)
    # A product of two halves is one operation; a quotient, or a product of whole numbers, is not.
    third = builder.lshr(builder.mul(upper, ir.Constant(_LONGS, [0x55555556] * LANES)), half)
    return builder.bitcast(builder.sub(_splat(builder, start, _LONGS), builder.shl(third, half)), _VECTOR)


def _wide(builder: ir.IRBuilder, value: Any) -> Any:
    return value if value.type == _VECTOR else _splat(builder, value, _VECTOR)


def _splat(builder: ir.IRBuilder, value: Any, vector: Any) -> Any:
    empty = ir.Constant(vector, ir.Undefined)
    one = builder.insert_element(empty, value, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(one, empty, ir.Constant(ir.VectorType(ir.IntType(32), LANES), None))
