"""Sums of rows of four numbers, each in one vector register.

Points are rows of x, y, z and an unused 0. This is written in the compiler's intermediate language, because
numba does not let the compiler join operations on neighbouring numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.arrayobj import make_array

_FOUR = ir.VectorType(ir.DoubleType(), 4)

_in_kernels = cast(Callable[[Callable[..., Any]], Any], intrinsic)


@_in_kernels
def spread(context: Any, points: Any, source: Any, row: Any, weight: Any, first: Any, last: Any) -> Any:
    """Subtract `weight[e]` times row `source` of `points` (n, 4) from its row `row[e]`, first ≤ e < last.

    The rows `row[e]` (without sign) must not be `source`.
    """
    return types.void(points, types.int64, row, weight, types.int64, types.int64), _spread


@_in_kernels
def gather(
    context: Any, out: Any, target: Any, scale: Any, factor: Any, points: Any, row: Any, weight: Any,
    first: Any, last: Any,
) -> Any:  # fmt: skip
    """Set row `target` of `out` (m, 4) to `scale` times itself and `factor` · Σ weight[e] · points[row[e]].

    The sum is over first ≤ e < last; `points` is (n, 4).
    """
    taken = types.int64, types.float64, types.float64, points, row, weight, types.int64, types.int64
    return types.void(out, *taken), _gather


def _spread(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
    points, source, row, weight, first, last = arguments
    data = _data(context, builder, signature.args[0], points)
    rows = _data(context, builder, signature.args[2], row)
    weights = _data(context, builder, signature.args[3], weight)
    amount = builder.fneg(_load(builder, data, source))
    with cgutils.for_range_slice(builder, first, last, ir.Constant(first.type, 1)) as (e, _):
        place = _row(builder, data, _index(builder, rows, e, first.type))
        moved = _added(builder, builder.load(place, align=8), _weight(builder, weights, e), amount)
        builder.store(moved, place, align=8)
    return context.get_dummy_value()


def _gather(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
    out, target, scale, factor, points, row, weight, first, last = arguments
    place = _row(builder, _data(context, builder, signature.args[0], out), target)
    data = _data(context, builder, signature.args[4], points)
    rows = _data(context, builder, signature.args[5], row)
    weights = _data(context, builder, signature.args[6], weight)
    # Two sums, because each waits for its last addition.
    sums = [cgutils.alloca_once_value(builder, ir.Constant(_FOUR, [0.0] * 4)) for _ in range(2)]

    def add(e: Any, total: Any) -> None:
        value = _load(builder, data, _index(builder, rows, e, first.type))
        builder.store(_added(builder, builder.load(total), _weight(builder, weights, e), value), total)

    one = ir.Constant(first.type, 1)
    before = builder.sub(last, one)
    with cgutils.for_range_slice(builder, first, before, ir.Constant(first.type, 2)) as (e, _):
        add(e, sums[0])
        add(builder.add(e, one), sums[1])
    odd = builder.and_(builder.sub(last, first), one)
    with builder.if_then(builder.icmp_signed("==", odd, one)):
        add(before, sums[0])
    total = builder.fadd(builder.load(sums[0]), builder.load(sums[1]))
    own = builder.fmul(_splat(builder, scale), builder.load(place, align=8))
    builder.store(_added(builder, own, _splat(builder, factor), total), place, align=8)
    return context.get_dummy_value()


def _data(context: Any, builder: ir.IRBuilder, kind: Any, array: Any) -> Any:
    return make_array(kind)(context, builder, array).data


def _index(builder: ir.IRBuilder, rows: Any, e: Any, wide: Any) -> Any:
    return builder.zext(builder.load(builder.gep(rows, [e])), wide)


def _weight(builder: ir.IRBuilder, weights: Any, e: Any) -> Any:
    return _splat(builder, builder.load(builder.gep(weights, [e])))


def _row(builder: ir.IRBuilder, data: Any, i: Any) -> Any:
    """Return a pointer to row i of an array (n, 4)."""
    start = builder.gep(data, [builder.mul(i, ir.Constant(i.type, 4))])
    return builder.bitcast(start, _FOUR.as_pointer())


def _load(builder: ir.IRBuilder, data: Any, i: Any) -> Any:
    return builder.load(_row(builder, data, i), align=8)


def _added(builder: ir.IRBuilder, total: Any, weight: Any, value: Any) -> Any:
    return builder.fadd(total, builder.fmul(weight, value, flags=("contract",)), flags=("contract",))


def _splat(builder: ir.IRBuilder, value: Any) -> Any:
    empty = ir.Constant(_FOUR, ir.Undefined)
    one = builder.insert_element(empty, value, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(one, empty, ir.Constant(ir.VectorType(ir.IntType(32), 4), None))
