"""The laws of the spring skin: exact at rest, a little late, a little over, stable and repeatable."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.parameters import MUSCLES, NEUTRAL
from risorius.face.muscles.muscles import ELSEWHERE, MuscleFields
from risorius.face.skin.biphasic import Biphasic
from risorius.face.skin.network import Network
from risorius.face.skin.springs import RATE, Springs

from ..conftest import values_of

BASES = [b for b in dict.fromkeys(m.base for m in MUSCLES) if b not in ELSEWHERE]
ONSET = 0.1  # s, about the shortest in which a muscle of the face contracts
REST = np.array(NEUTRAL)


@pytest.fixture(scope="module")
def parts(head):
    return Network.of(head), MuscleFields.of(head)


@pytest.fixture(scope="module", params=["linear", "biphasic"])
def springs(request, head, parts):
    network, fields = parts
    return Springs(
        network, fields, second_phase=Biphasic(*parts, head) if request.param == "biphasic" else None
    )


def placed(springs, head, share=1.0):
    out = np.zeros_like(head.rest)
    springs.place(share, out)
    return out[springs.network.free]


def field_of(head, base, free):
    whole = np.zeros_like(head.rest)
    for m in MUSCLES:
        if m.base == base:
            whole[head.fields[m.name].vertices] += head.fields[m.name].displacement
    return whole[free]


def test_rest_stays_at_rest(springs, head):
    springs.come_to_rest(REST)
    for _ in range(5):
        springs.step(REST)
    assert not placed(springs, head).any()


@pytest.mark.parametrize("muscle", [m.name for m in MUSCLES if m.base not in ELSEWHERE])
def test_a_muscle_alone_comes_to_its_calibrated_field(springs, head, muscle):
    values = values_of({muscle: 1.0})
    springs.come_to_rest(REST)
    for _ in range(2 * RATE):
        springs.step(values)
    whole = np.zeros_like(head.rest)
    whole[head.fields[muscle].vertices] = head.fields[muscle].displacement
    field, found = whole[springs.network.free], placed(springs, head)
    assert np.abs(found - field).max() <= 0.05
    assert 1.0 - ((found - field) ** 2).sum() / (field**2).sum() >= 0.999


@pytest.mark.parametrize("base", BASES)
def test_lag_and_overshoot_of_a_fast_contraction(parts, head, base):
    springs = Springs(*parts)
    field = field_of(head, base, springs.network.free)
    length = np.linalg.norm(field, axis=1)
    strong = length > 0.1 * length.max()
    springs.come_to_rest(REST)
    course = []
    for step in range(1, RATE // 2):
        springs.step(values_of({base: min(step / RATE / ONSET, 1.0)}))
        course.append((placed(springs, head) * field).sum(axis=1)[strong] / length[strong] ** 2)
    along = np.array(course)
    overshoot = along.max(axis=0).mean() - 1.0
    assert 0.03 <= overshoot <= 0.08
    middle = along.mean(axis=1)
    after = int(np.argmax(middle > 0.5))
    half = (after + (0.5 - middle[after - 1]) / (middle[after] - middle[after - 1])) / RATE
    assert 0.0 < half - 0.5 * ONSET <= 0.020


def test_a_sudden_step_neither_explodes_nor_rings_for_long(springs, head):
    springs.come_to_rest(REST)
    values = values_of({"AU12": 1.0, "AU4": 1.0, "AU9": 1.0, "AU17": 1.0})
    size = []
    for _ in range(RATE):
        springs.step(values)
        size.append(np.abs(placed(springs, head)).max())
    assert max(size) < 1.3 * size[-1]
    assert np.ptp(size[RATE // 2 :]) < 0.1


def test_biphasic_springs_move_less_under_several_muscles(parts, head):
    values = values_of({"AU12": 1.0, "AU6": 1.0, "AU9": 1.0, "AU20": 1.0})
    linear, biphasic = Springs(*parts), Springs(*parts, second_phase=Biphasic(*parts, head))
    linear.come_to_rest(values)
    biphasic.come_to_rest(values)
    one, other = placed(linear, head), placed(biphasic, head)
    assert np.abs(one - other).max() > 0.1
    assert np.linalg.norm(other) < np.linalg.norm(one)


def test_a_settled_skin_is_in_equilibrium(springs, head):
    values = values_of({"AU12": 0.8, "AU6": 1.0, "AU10": 0.7})
    springs.come_to_rest(values)
    before = placed(springs, head)
    for _ in range(RATE):
        springs.step(values)
    assert np.abs(placed(springs, head) - before).max() < 0.05


def test_between_two_steps_lies_a_straight_line(springs, head):
    springs.come_to_rest(REST)
    springs.step(values_of({"AU12": 0.5}))
    ends = [placed(springs, head, share) for share in (0.0, 1.0)]
    np.testing.assert_allclose(placed(springs, head, 0.25), 0.75 * ends[0] + 0.25 * ends[1], atol=1e-12)


def test_two_states_do_not_meet(parts, head):
    one, other = Springs(*parts), Springs(*parts)
    other.come_to_rest(values_of({"AU12": 1.0}))
    one.come_to_rest(REST)
    one.step(REST)
    assert not placed(one, head).any()
