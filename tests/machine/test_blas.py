import numpy as np
from threadpoolctl import threadpool_info, threadpool_limits

from risorius.machine.blas import one_thread


def threads() -> set[int]:
    return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}


def test_linear_algebra_has_one_thread_within_and_as_many_as_before_after() -> None:
    assert np.eye(2).size
    with threadpool_limits(3, user_api="blas"):
        with one_thread():
            assert threads() == {1}
        assert threads() == {3}
