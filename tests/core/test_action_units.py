import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.action_units import ACTION_UNITS, NOT_SHOWN, resolve_targets
from risorius.core.parameters import INDEX, PARAMETERS
from risorius.errors import ParameterError


@pytest.mark.parametrize(
    ("targets", "message"),
    [
        ({"AU34": 0.5}, "AU34 .cheek puff. cannot be shown"),
        ({"AU99": 0.5}, "unknown action unit"),
        ({"AU12": 1.5}, "AU12 = 1.5 is out of range"),
        ({"AU12": float("nan")}, "out of range"),
        ({"AU26.left": 0.5}, "AU26 .jaw drop. has no sides"),
        ({"smile": 0.5}, "unknown muscle or parameter"),
        ({"masseter": -0.1}, "out of range"),
    ],
)
def test_bad_targets(targets: dict[str, float], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        resolve_targets(targets)


@pytest.mark.parametrize(
    ("targets", "expected"),
    [
        ({"AU12.left": 0.5}, {"zygomatic_major.left": 0.5}),
        ({"au01": 1.0}, {"frontalis_medialis.left": 1.0, "frontalis_medialis.right": 1.0}),
        ({"AU45.R": 1.0}, {"orbicularis_oculi_palpebralis.right": 1.0}),
        ({"AU26": 1.0, "jaw_open": 0.25}, {"masseter": 0.6}),
        ({"AU27": 1.0, "AU26": 1.0}, {"masseter": 1.0}),
        ({"head_pitch": -5.0}, {"head_pitch": -5.0}),
    ],
)
def test_units_add_then_clip(targets: dict[str, float], expected: dict[str, float]) -> None:
    assert resolve_targets(targets) == pytest.approx(expected)


def test_no_unit_is_both_shown_and_not() -> None:
    assert not set(ACTION_UNITS) & set(NOT_SHOWN)


@given(st.dictionaries(st.sampled_from([f"AU{n}" for n in ACTION_UNITS]), st.floats(0, 1), max_size=8))
def test_results_are_in_range_and_in_the_order_of_the_table(targets: dict[str, float]) -> None:
    resolved = resolve_targets(targets)
    positions = [INDEX[name] for name in resolved]
    assert positions == sorted(positions)
    assert all(PARAMETERS[INDEX[n]].low <= v <= PARAMETERS[INDEX[n]].high for n, v in resolved.items())
