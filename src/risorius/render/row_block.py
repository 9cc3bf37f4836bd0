"""Test and write sixteen samples of a row at once in the processor's vector registers.

This is written in the compiler's intermediate language, because the compiler turns a Python loop into vector
code only if it can prove that no two arrays overlap.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from numba.np.arrayobj import make_array

LANES = 16
_NUMBER = ir.IntType(32)
_NUMBERS = ir.VectorType(_NUMBER, LANES)
_REALS = ir.VectorType(ir.FloatType(), LANES)
_THREE, _FIVE = types.UniTuple(types.int32, 3), types.UniTuple(types.int32, 5)

_in_kernels = cast(Callable[[Callable[..., Any]], Any], intrinsic)


@_in_kernels
def cover(
    context: Any, depth: Any, ids: Any, place: Any, edges: Any, steps: Any, key: Any, step: Any, number: Any
) -> Any:
    """Give those of LANES samples from `place` on to triangle `number` that it covers as the nearest.

    `depth` (float32) and `ids` (int32) hold the rows of samples one after another, and `place` counts from
    the first. `edges` are the triangle's three edge functions at the first sample, `steps` their increments
    (int32): a sample is covered if none of the three is negative. `key` (float32) is the nearness at the
    first sample, `step` its increment.
    """
    taken = types.int64, _THREE, _THREE, types.float32, types.float32, types.int32
    return types.void(depth, ids, *taken), _cover


@_in_kernels
def cover_ribbon(
    context: Any, depth: Any, ids: Any, place: Any, edges: Any, steps: Any, key: Any, step: Any, number: Any
) -> Any:
    """Do what `cover` does for a quad of two triangles, `number` and the next.

    Of the five edge functions the last is the diagonal's: it is negative in the second triangle.
    """
    taken = types.int64, _FIVE, _FIVE, types.float32, types.float32, types.int32
    return types.void(depth, ids, *taken), _cover_ribbon


@_in_kernels
def cover_depth(context: Any, depth: Any, place: Any, edges: Any, steps: Any, key: Any, step: Any) -> Any:
    """Do what `cover` does without recording which triangle a sample shows."""
    return types.void(depth, types.int64, _THREE, _THREE, types.float32, types.float32), _cover_depth


def _cover(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
    depth, ids, place, edges, steps, key, step, number = arguments
    nearest = _lanes(context, builder, signature.args[0], depth, place, _REALS)
    wins = _win(builder, nearest, edges, steps, 3, key, step)
    _show(
        builder,
        _lanes(context, builder, signature.args[1], ids, place, _NUMBERS),
        wins,
        _splat(builder, number, _NUMBERS),
    )
    return context.get_dummy_value()


def _cover_ribbon(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
    depth, ids, place, edges, steps, key, step, number = arguments
    nearest = _lanes(context, builder, signature.args[0], depth, place, _REALS)
    wins = _win(builder, nearest, edges, steps, 4, key, step)
    beyond = builder.ashr(_edge(builder, edges, steps, 4), ir.Constant(_NUMBERS, [31] * LANES))
    triangles = builder.sub(_splat(builder, number, _NUMBERS), beyond)
    _show(builder, _lanes(context, builder, signature.args[1], ids, place, _NUMBERS), wins, triangles)
    return context.get_dummy_value()


def _cover_depth(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
    depth, place, *where = arguments
    edges, steps, key, step = where
    _win(
        builder, _lanes(context, builder, signature.args[0], depth, place, _REALS), edges, steps, 3, key, step
    )
    return context.get_dummy_value()


def _win(builder: ir.IRBuilder, nearest: Any, edges: Any, steps: Any, count: int, key: Any, step: Any) -> Any:
    """Update the nearest keys; return the lanes in which a shape of `count` edges is the nearest."""
    none = ir.Constant(_NUMBERS, None)
    below = none
    for edge in range(count):
        below = builder.or_(below, _edge(builder, edges, steps, edge))
    counted = ir.Constant(_REALS, [float(lane) for lane in range(LANES)])
    grown = builder.fmul(_splat(builder, step, _REALS), counted)
    near = builder.fadd(_splat(builder, key, _REALS), grown)
    old = builder.load(nearest, align=4)
    wins = builder.and_(builder.icmp_signed(">=", below, none), builder.fcmp_ordered(">", near, old))
    builder.store(builder.select(wins, near, old), nearest, align=4)
    return wins


def _edge(builder: ir.IRBuilder, edges: Any, steps: Any, edge: int) -> Any:
    """Return an edge function in all lanes."""
    lanes = ir.Constant(_NUMBERS, list(range(LANES)))
    start, grows = (_splat(builder, builder.extract_value(of, edge), _NUMBERS) for of in (edges, steps))
    return builder.add(start, builder.mul(grows, lanes))


def _show(builder: ir.IRBuilder, shown: Any, wins: Any, triangles: Any) -> None:
    """Write which triangle the lanes that it wins show."""
    builder.store(builder.select(wins, triangles, builder.load(shown, align=4)), shown, align=4)


def _lanes(context: Any, builder: ir.IRBuilder, kind: Any, array: Any, place: Any, vector: Any) -> Any:
    """Return a pointer to the vector of an array's elements from `place` on."""
    first = make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(first, [place]), vector.as_pointer())


def _splat(builder: ir.IRBuilder, value: Any, vector: Any) -> Any:
    """Return a vector of one value in all lanes."""
    empty = ir.Constant(vector, ir.Undefined)
    one = builder.insert_element(empty, value, ir.Constant(_NUMBER, 0))
    return builder.shuffle_vector(one, empty, ir.Constant(_NUMBERS, None))
