"""Paper A's combination on hand-made scores, where the tests of single formulas leave something open."""

from __future__ import annotations

import numpy as np
import pytest

from risorius import blend
from risorius.core.arrays import Array
from risorius.core.movement import Movement
from risorius.core.parameters import BASES, INDEX
from risorius.core.score import BlendSettings, Score
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver

ZYGOMATIC, TRIANGULARIS = "zygomatic_major.left", "triangularis.left"
TABLE_2 = {
    1: (3, 4, 6, 7, 12), 2: (3, 4, 6, 7, 12), 3: (1, 2, 7), 4: (1, 2, 7), 5: (6, 8), 6: (1, 2, 5),
    7: (1, 2, 3, 4, 8), 8: (5, 7, 11, 12), 9: (11,), 11: (8, 9, 16), 12: (1, 2, 8), 16: (11, 17), 17: (16,),
}  # fmt: skip
"""As printed, but for 16, whose row lacks 17."""
ONE_OF_EACH = {sides[0].number: sides[0].name for sides in BASES.values() if sides[0].number}


def rise(x: Array | float, seconds: float) -> Array:
    return np.asarray(2.0 ** (np.asarray(x) / seconds) - 1.0)


def fall(x: Array | float, seconds: float) -> Array:
    return np.asarray(2.0 ** (1.0 - np.asarray(x) / seconds) - 1.0)


def curve(times: Array, parameter: str, *movements: Movement, **settings: object) -> Array:
    score = Score(max(m.end for m in movements), movements, settings=BlendSettings(**settings))  # type: ignore[arg-type]
    return blend.at(score, times)[:, INDEX[parameter]]


def display(
    start: float, end: float, onset: float, offset: float, value: float, name: str = ZYGOMATIC
) -> Movement:
    return Movement("emotion", start, end, onset, offset, {name: value})


@pytest.mark.parametrize("value", [0.15, 0.6, 1.0])
@pytest.mark.parametrize(("start", "end", "onset", "offset"), [(0.3, 2.1, 0.4, 1.1), (1.0, 1.9, 0.6, 0.3)])
def test_one_movement_is_the_formula(
    value: float, start: float, end: float, onset: float, offset: float
) -> None:
    times = np.linspace(0.0, end, 997)
    shape = np.minimum(np.minimum(rise(times - start, onset), fall(times - end + offset, offset)), 1.0)
    wanted = value * np.clip(shape, 0.0, None)
    assert np.abs(curve(times, ZYGOMATIC, display(start, end, onset, offset, value)) - wanted).max() < 1e-9


@pytest.mark.parametrize(
    ("first", "second", "apart"), [(1.0, 0.0, 0.0), (0.6, 0.0, 0.116), (1.0, 0.3, 0.068), (0.6, 0.3, 0.010)]
)
def test_a_release_is_the_first_movement_s_own_only_from_1_to_0(
    first: float, second: float, apart: float
) -> None:
    """Movement 2 begins in the offset of movement 1; docs/theory.md says so."""
    one = display(0.0, 5.0, 1.0, 2.0, first)
    two = Movement("emotion", 3.5, 8.0, 1.0, 1.0, {ZYGOMATIC: second} if second else {TRIANGULARIS: 0.5})
    times = np.linspace(3.5, 8.0, 2001)
    both, alone = curve(times, ZYGOMATIC, one, two), curve(times, ZYGOMATIC, one)
    # Until it has come to the target of movement 2.
    falling = (both > second + 1e-9) & (alone > second + 1e-9)
    assert np.abs(both - alone)[falling].max() == pytest.approx(apart, abs=0.002)
    level = float(curve(np.array([3.5]), ZYGOMATIC, one)[0])
    xi = 2.0 * (1.0 - np.log2(1.0 + level - second))
    wanted = second + fall(times - 3.5 + xi, 2.0)
    within = times < 3.5 + min(2.0 - xi, 1.0)
    assert np.abs(both - wanted)[within].max() < 1e-9


def test_what_the_second_movement_lacks_is_released_and_what_it_adds_rises() -> None:
    """Section 5.2, for muscles of one movement alone: PV = 0 in the other."""
    one, two = display(0.0, 4.0, 0.5, 0.8, 0.9), display(2.0, 6.0, 1.2, 0.5, 0.7, "mentalis.left")
    times = np.linspace(2.0, 3.2, 601)
    xi = 0.8 * (1.0 - np.log2(1.9))
    released = np.clip(fall(times - 2.0 + xi, 0.8), 0.0, None)
    assert np.abs(curve(times, ZYGOMATIC, one, two) - released).max() < 1e-9
    risen = np.minimum(rise(times - 2.0, 1.2), 0.7)
    assert np.abs(curve(times, "mentalis.left", one, two) - risen).max() < 1e-9


@pytest.mark.parametrize("levels", [(1.0, 0.4, 0.9), (0.3, 0.8, 0.2, 1.0), (0.5, 0.5, 0.1, 0.6, 0.9)])
def test_more_movements_follow_in_the_same_manner(levels: tuple[float, ...]) -> None:
    movements = [display(2.0 * k, 2.0 * k + 2.6, 0.5, 0.7, level) for k, level in enumerate(levels)]
    plateaus = np.array([2.0 * k + 1.7 for k in range(len(levels))])
    assert curve(plateaus, ZYGOMATIC, *movements) == pytest.approx(levels)
    times = np.linspace(0.0, movements[-1].end, 20_001)
    assert np.abs(np.diff(curve(times, ZYGOMATIC, *movements))).max() < 0.003


def test_every_pair_of_muscles_is_a_rival_as_table_2_has_it() -> None:
    """All 342 ordered pairs, one after the other: of a rival, the one of higher priority alone is left."""
    pairs = [(low, high) for low in ONE_OF_EACH for high in ONE_OF_EACH if low != high]
    assert len(pairs) == 342
    movements = []
    for k, (low, high) in enumerate(pairs):
        start = 2.0 * k
        movements.append(display(start, start + 1.5, 0.1, 0.1, 0.8, ONE_OF_EACH[low]))
        movements.append(Movement("signals", start + 0.5, start + 1.0, 0.1, 0.1, {ONE_OF_EACH[high]: 0.6}))
    score = Score(2.0 * len(pairs), tuple(movements), settings=BlendSettings(contact=False))
    middles = blend.at(score, np.arange(len(pairs)) * 2.0 + 0.75)
    for values, (low, high) in zip(middles, pairs, strict=True):
        left = 0.0 if high in TABLE_2.get(low, ()) else 0.8
        found = values[[INDEX[ONE_OF_EACH[low]], INDEX[ONE_OF_EACH[high]]]]
        assert found == pytest.approx([left, 0.6], abs=1e-9), (low, high)


@pytest.mark.parametrize(("start", "minimum"), [(2.0, 0.12), (2.3, 0.5), (3.1, 0.25)])
def test_a_muscle_gives_way_by_psi_whatever_the_minimum(start: float, minimum: float) -> None:
    smile = display(0.0, 6.0, 0.5, 0.5, 0.9)
    lips = Movement("signals", start, start + 0.8, 0.2, 0.2, {"orbicularis_oris_funneler": 0.7})
    times = np.linspace(start - 0.6, start, 1201)
    shown = curve(times, ZYGOMATIC, smile, lips, min_onset=minimum, min_offset=minimum)
    begins = start + 0.2 * np.log2(1.0 + 0.1 / 0.7)  # there the rival is over its threshold of 0.1
    assert np.abs(shown - np.minimum(0.9, rise(begins - times, minimum))).max() < 1e-6


def test_each_of_the_35_muscles_moves_the_skin() -> None:
    head = load_head()
    solver = FaceSolver(head)
    neutral = np.zeros(len(INDEX))
    neutral[INDEX["gaze_distance"]] = 0.8
    rest = solver.solve(neutral).skin.copy()
    names = [side.name for sides in BASES.values() for side in sides if side.number]
    assert len(names) == 35
    for name in names:
        values = neutral.copy()
        values[INDEX[name]] = 1.0
        moved = np.linalg.norm(solver.solve(values).skin - rest, axis=1).max()
        assert 1.5 < moved < 45.0, name
