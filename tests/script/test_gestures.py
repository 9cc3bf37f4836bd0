from itertools import pairwise

import pytest

from risorius.core.movement import Movement
from risorius.script.markup import parse_markup
from risorius.script.movements import movements_of


def movements(attributes: str) -> tuple[Movement, ...]:
    return movements_of(parse_markup(f'<PHONEME text="hi"/><HEAD time="1" {attributes}/>'), (), 9.0)


def peaks(attributes: str, parameter: str) -> list[float]:
    return [m.targets[parameter] for m in movements(attributes)]


@pytest.mark.parametrize(("value", "depth"), [("1", -8.0), ("0.5", -4.0), ("1.0", -8.0)])
def test_a_nod_goes_down(value: str, depth: float) -> None:
    assert peaks(f'nod="{value}"', "head_pitch") == pytest.approx([depth, -0.15 * depth])


def test_no_nod_does_not_move() -> None:
    assert set(peaks('nod="0"', "head_pitch")) == {0.0}


def test_nods_shrink() -> None:
    down = peaks('nod="3"', "head_pitch")[::2]
    assert down == pytest.approx([-8.0, -8.0 * 0.85, -8.0 * 0.85**2])


def test_a_shake_goes_both_ways() -> None:
    assert peaks('shake="2" amplitude="10"', "head_yaw") == pytest.approx([10.0, -10.0, 8.5, -8.5])


@pytest.mark.parametrize("attributes", ['nod="1"', 'nod="4"', 'shake="2"', 'shake="3" duration="2"'])
def test_each_part_starts_where_the_one_before_is_fully_out(attributes: str) -> None:
    parts = movements(attributes)
    for before, after in pairwise(parts):
        assert after.start == pytest.approx(before.start + before.onset)
        assert after.start < before.end < after.end
    assert all(m.onset + m.offset == pytest.approx(m.end - m.start) for m in parts)


def test_a_gesture_fills_its_span() -> None:
    parts = movements('nod="2" duration="1.5"')
    assert (parts[0].start, parts[-1].end) == (1.0, 2.5)
    assert movements('nod="2"')[-1].end == pytest.approx(1.0 + 5 * 0.17)
    assert movements('nod="2" end="end"')[-1].end == 9.0


def test_parts_have_names_of_their_own_and_one_cause() -> None:
    parts = movements('nod="2"')
    assert [m.id for m in parts] == [f"head@1.21.{n}" for n in (1, 2, 3, 4)]
    assert {m.cause.trigger for m in parts} == {'HEAD nod="2"'}
