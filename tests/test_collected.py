"""A loop over cases tries all of them, and names each that fails."""

from __future__ import annotations

import pytest

from .collected import all_cases


def run(tried: list[int]) -> None:
    with all_cases() as case:
        for number in range(4):
            with case(f"number {number}"):
                tried.append(number)
                assert number % 2, "even"


def run_other_kinds() -> None:
    with all_cases() as case:
        with case("a"):
            {}["missing"]
        with case("b"):
            pytest.fail("told")


def run_none() -> None:
    with all_cases():
        pass


def test_all_that_fail_are_named() -> None:
    tried: list[int] = []
    with pytest.raises(pytest.fail.Exception) as failed:
        run(tried)
    assert tried == [0, 1, 2, 3]
    first, *named = str(failed.value).splitlines()
    assert first == "2 of 4 cases failed:"
    assert [line.partition(": test_collected.py:")[0] for line in named] == ["number 0", "number 2"]


def test_a_failure_of_any_kind_counts() -> None:
    with pytest.raises(pytest.fail.Exception, match=r"a: .*KeyError: 'missing'\nb: .*told"):
        run_other_kinds()


def test_no_case_at_all_is_a_failure() -> None:
    with pytest.raises(AssertionError, match="no case was tried"):
        run_none()
