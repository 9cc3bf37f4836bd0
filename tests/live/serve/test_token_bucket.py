"""How much may come in a while, by a clock that the test sets."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from risorius.live.serve.token_bucket import TokenBucket


def test_much_may_come_at_once_and_little_in_the_long_run() -> None:
    time = 5.0
    bucket = TokenBucket(2.0, 10.0, lambda: time)
    assert bucket.take(10)
    assert not bucket.take()
    time = 5.5
    assert bucket.take()
    assert not bucket.take()
    time = 1_000.0
    assert not bucket.take(11)
    assert bucket.take(10)


@given(st.lists(st.tuples(st.floats(0, 10), st.floats(0, 30))))
def test_no_more_comes_than_the_rate_and_what_came_at_once(steps: list[tuple[float, float]]) -> None:
    time, came = 0.0, 0.0
    bucket = TokenBucket(3.0, 20.0, lambda: time)
    for wait, amount in steps:
        time += wait
        came += amount if bucket.take(amount) else 0.0
        assert came <= 20.0 + 3.0 * time + 1e-6
