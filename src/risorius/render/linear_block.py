"""Read the colours of the four samples of a pixel at once in the processor's vector registers.

This is written in the compiler's intermediate language for the same reason as `row_block`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.arrayobj import make_array

GROUP = 8
"""Columns that are read at once."""
COLUMNS = 4 * GROUP
"""Columns of a row of `linear.LinearTriangles.planes`."""
SAMPLES = 4
_RETURNED = 12
_FLOATS = ir.VectorType(ir.FloatType(), GROUP)
_NUMBER = ir.IntType(32)

Mean = tuple[float, float, float, float, float, float, float, float, float, float, float, float]

_in_kernels = cast(Callable[[Callable[..., Any]], Any], intrinsic)


@_in_kernels
def mean_at(context: Any, planes: Any, rows: Any, x: Any, y: Any) -> Any:
    """Return the means over the 2 × 2 samples from (x, y) on, (float32) the middle of the first.

    `planes` (n, COLUMNS) float32 holds GROUP values at the origin, what they gain from sample to sample to
    the right, what they gain downwards, and GROUP values that do not change; `rows` (four int64) are the rows
    of the samples' triangles. The first GROUP numbers returned are means of linear values, the others
    of constant ones.
    """
    four = types.UniTuple(types.int64, SAMPLES)
    return types.UniTuple(types.float32, _RETURNED)(planes, four, types.float32, types.float32), _mean_at


def _mean_at(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
    planes, rows, x, y = arguments
    data = make_array(signature.args[0])(context, builder, planes).data
    places = [
        builder.mul(builder.extract_value(rows, k), ir.Constant(ir.IntType(64), COLUMNS))
        for k in range(SAMPLES)
    ]
    across = [_splat(builder, x), _splat(builder, builder.fadd(x, ir.Constant(ir.FloatType(), 1.0)))]
    down = [_splat(builder, y), _splat(builder, builder.fadd(y, ir.Constant(ir.FloatType(), 1.0)))]
    linear = constant = ir.Constant(_FLOATS, [0.0] * GROUP)
    for k, place in enumerate(places):
        start, right, below, same = (_load(builder, data, place, group) for group in range(4))
        linear = _add(builder, linear, start)
        linear = _add(builder, linear, _times(builder, right, across[k % 2]))
        linear = _add(builder, linear, _times(builder, below, down[k // 2]))
        constant = _add(builder, constant, same)
    share = ir.Constant(_FLOATS, [1.0 / SAMPLES] * GROUP)
    linear, constant = _times(builder, linear, share), _times(builder, constant, share)
    lanes = [(linear, lane) for lane in range(GROUP)]
    lanes += [(constant, lane) for lane in range(_RETURNED - GROUP)]
    numbers = [builder.extract_element(vector, ir.Constant(_NUMBER, lane)) for vector, lane in lanes]
    return cgutils.pack_array(builder, numbers)


def _load(builder: ir.IRBuilder, data: Any, place: Any, group: int) -> Any:
    """Return a group of GROUP columns of the row that begins at `place`."""
    first = builder.add(place, ir.Constant(ir.IntType(64), group * GROUP))
    return builder.load(builder.bitcast(builder.gep(data, [first]), _FLOATS.as_pointer()), align=4)


def _add(builder: ir.IRBuilder, a: Any, b: Any) -> Any:
    return builder.fadd(a, b, flags=("contract",))


def _times(builder: ir.IRBuilder, a: Any, b: Any) -> Any:
    return builder.fmul(a, b, flags=("contract",))


def _splat(builder: ir.IRBuilder, value: Any) -> Any:
    """Return a vector of one value in all lanes."""
    empty = ir.Constant(_FLOATS, ir.Undefined)
    one = builder.insert_element(empty, value, ir.Constant(_NUMBER, 0))
    return builder.shuffle_vector(one, empty, ir.Constant(ir.VectorType(_NUMBER, GROUP), None))
