"""Functions that only kernels call are compiled once for each set of types, whoever calls them."""

from __future__ import annotations

import numpy as np
from numba.core import event

from risorius.core.arrays import Array
from risorius.core.kernels.jit import device, fast_kernel, kernel, summing_kernel


@device
def scaled(x: float, times: int) -> float:
    return x * times


@kernel
def exact(values: Array, out: Array) -> None:
    for k in range(len(values)):
        out[k] = scaled(values[k], 2) + scaled(values[k], times=3)


@summing_kernel
def summing(values: Array, out: Array) -> None:
    for k in range(len(values)):
        out[k] = scaled(values[k], k)


@fast_kernel
def fast(values: Array, out: Array) -> None:
    for k in range(len(values)):
        out[k] = scaled(values[k], 7)


def test_kernels_of_all_arithmetics_share_one_form_of_a_device() -> None:
    values, out = np.arange(4.0), np.empty(4)
    expected = {exact: 5.0 * values, summing: values**2, fast: 7.0 * values}
    for function, result in expected.items():
        # Compiled now, not read from the cache, which would not compile the device.
        vars(function)["_cache"].flush()
        function(values, out)
        np.testing.assert_array_equal(out, result)
    assert len(vars(scaled)["dispatcher"].overloads) == 1


def test_python_calls_a_device_that_is_not_compiled() -> None:
    assert scaled("ab", 2) == "abab"  # type: ignore[arg-type, comparison-overlap]


@device
def widened(x: float, n: int) -> float:
    return max(x, n, 0.5) + min(n, 2)


@kernel
def extremes(values: Array, out: Array) -> None:
    for k in range(len(values)):
        out[k] = widened(values[k], k) - max(values[k], values[0])


def test_least_and_greatest_are_those_of_python() -> None:
    values, out = np.array([0.25, np.nan, -3.0, 7.5]), np.empty(4)
    vars(extremes)["_cache"].flush()
    extremes(values, out)
    expected = [max(x, n, 0.5) + min(n, 2) - max(x, values[0]) for n, x in enumerate(values)]
    np.testing.assert_array_equal(out, expected)


def test_numba_compiles_no_function_for_the_greatest_of_numbers() -> None:
    extremes(np.ones(1), np.ones(1))
    with event.install_recorder("numba:compile") as recorded:
        extremes.recompile()  # type: ignore[attr-defined]
    names = {entry.data["dispatcher"].py_func.__name__ for _, entry in recorded.buffer}
    assert names <= {"extremes", "widened"}
