import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.parameters import (
    CONFLICTING_NUMBERS,
    INDEX,
    MUSCLES,
    NAMES,
    PARAMETERS,
    RIVALS,
    Kind,
    check_value,
    parameters_named,
)
from risorius.errors import ParameterError


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("zygomatic_mayor", "did you mean 'zygomatic_major'"),
        ("masseter.left", "expected no side"),
        ("risorius.top", "expected .left or .right"),
        ("", "unknown muscle"),
    ],
)
def test_unknown_names_are_reported_with_what_was_expected(name: str, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        parameters_named(name)


@pytest.mark.parametrize("value", [-0.01, 1.01, float("nan"), float("inf")])
def test_values_out_of_range_are_refused(value: float) -> None:
    with pytest.raises(ParameterError, match=r"masseter = .* expected 0 to 1"):
        check_value(PARAMETERS[INDEX["masseter"]], value)


def test_there_are_35_muscles_in_19_rows() -> None:
    assert len(MUSCLES) == 35
    assert {p.number for p in MUSCLES} == set(range(1, 20))
    assert len(NAMES) == len(set(NAMES)) == 46


def test_muscles_come_first_in_the_order_of_paper_a() -> None:
    numbers = [p.number for p in PARAMETERS if p.kind is Kind.MUSCLE]
    assert numbers == sorted(numbers)
    assert NAMES[:2] == ("zygomatic_major.left", "zygomatic_major.right")
    assert NAMES[34:36] == ("masseter", "lip_seal")
    assert NAMES[-1] == "gaze_distance"


def test_a_name_without_side_means_both() -> None:
    assert [p.name for p in parameters_named("Risorius")] == ["risorius.left", "risorius.right"]
    assert [p.name for p in parameters_named("jaw_open")] == ["masseter"]
    assert [p.name for p in parameters_named("lip-pressor")] == ["orbicularis_oris_presser"]


@given(st.sampled_from(NAMES))
def test_conflict_is_symmetric_and_never_with_oneself(name: str) -> None:
    assert name not in RIVALS[name]
    assert all(name in RIVALS[rival] for rival in RIVALS[name])


def test_conflict_is_tested_per_side() -> None:
    assert "triangularis.left" in RIVALS["zygomatic_major.left"]
    assert "triangularis.right" not in RIVALS["zygomatic_major.left"]
    assert "orbicularis_oris_funneler" in RIVALS["zygomatic_major.left"]
    assert {"zygomatic_major.left", "zygomatic_major.right"} <= set(RIVALS["orbicularis_oris_funneler"])


def test_table_2_has_twenty_pairs() -> None:
    assert len(CONFLICTING_NUMBERS) == len({frozenset(pair) for pair in CONFLICTING_NUMBERS}) == 20
