from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest

from risorius.core.parameters import INDEX, MUSCLES, PARAMETERS
from risorius.errors import HeadError
from risorius.face.muscles.activations import HALF, YIELDS, joint_share
from risorius.face.muscles.muscles import ELSEWHERE, EXCESS, FREE_EXCESS, SHEETS, DisplacedSkin, MuscleFields

from ..conftest import values_of

PRESSER = "orbicularis_oris_presser"


def moved(head, **targets):
    out = np.full_like(head.rest, np.nan)
    MuscleFields.of(head).displace(values_of(targets), out)
    return out


@pytest.fixture(scope="module")
def displaced(head):
    fields = MuscleFields.of(head)

    def displace(**targets):
        out = np.full_like(head.rest, np.nan)
        fields.displace(values_of(targets), out)
        return out

    return displace


def dense(head, *names):
    out = np.zeros_like(head.rest)
    for name in names:
        out[head.fields[name].vertices] += head.fields[name].displacement
    return out


def test_no_activation_moves_nothing(displaced):
    assert not displaced().any()


@pytest.mark.parametrize("muscle", [m.name for m in MUSCLES if m.base not in ELSEWHERE])
def test_a_muscle_alone_reproduces_its_field_in_proportion(displaced, head, muscle):
    field = dense(head, muscle)
    assert np.abs(field).max() > 0.5
    np.testing.assert_allclose(displaced(**{muscle: 1.0}), field, atol=1e-9)
    np.testing.assert_allclose(displaced(**{muscle: 0.3}), 0.3 * field, atol=1e-9)


@pytest.mark.parametrize("base", ["zygomatic_major", "frontalis_medialis", "levator_labii_nasi"])
def test_both_sides_of_a_muscle_add_up(displaced, head, base):
    both = dense(head, f"{base}.left", f"{base}.right")
    np.testing.assert_allclose(displaced(**{base: 1.0}), both, atol=1e-9)


@pytest.mark.parametrize("tiny", [5e-324, 3e-139, 1e-12])
def test_an_activation_next_to_nothing_does_nothing(displaced, tiny):
    alone = displaced(**{"zygomatic_minor.left": 1.0})
    found = displaced(**{"zygomatic_minor.left": 1.0, "zygomatic_major.left": tiny})
    np.testing.assert_allclose(found, alone, atol=1e-9)


def test_what_is_kept_from_call_to_call_is_what_all_anew_gives(head):
    fields, draw = MuscleFields.of(head), np.random.default_rng(1)
    kept, anew = DisplacedSkin(fields), np.empty_like(head.rest)
    values = np.zeros(len(PARAMETERS))
    for _ in range(20):
        some = draw.integers(0, len(MUSCLES), 5)
        values[some] = draw.choice([0.0, 1.0], 5) * draw.random(5)
        fields.displace(values, anew)
        np.testing.assert_array_equal(kept.at(values), anew)


def test_fields_at_some_vertices_move_those_as_all_fields_do(head):
    fields, some = MuscleFields.of(head), np.arange(0, len(head.rest), 2)
    whole, part = np.empty_like(head.rest), np.empty((len(some), 3))
    fields.displace(values_of({"AU12": 1.0}), whole)
    fields.at(some).displace(values_of({"AU12": 1.0}), part)
    assert part.any()
    np.testing.assert_array_equal(part, whole[some])


def test_the_heads_of_a_sheet_add_up_within_the_cap(displaced, head):
    bases = ("depressor_supercilii", *(b for b, sheet in SHEETS.items() if sheet == "depressor_supercilii"))
    all_heads = dense(head, *(f"{base}.left" for base in bases))
    found = displaced(**{f"{b}.left": 1.0 for b in bases})
    alone = [np.linalg.norm(displaced(**{f"{b}.left": 1.0}), axis=1) for b in bases]
    free = np.linalg.norm(all_heads, axis=1) <= np.max(alone, axis=0) + FREE_EXCESS
    assert free.mean() > 0.95
    np.testing.assert_allclose(found[free], all_heads[free], atol=1e-9)
    assert (np.linalg.norm(found, axis=1) <= np.linalg.norm(all_heads, axis=1) + 1e-9).all()


def test_any_two_muscles_overshoot_the_larger_by_little(displaced):
    bases = [b for b in dict.fromkeys(m.base for m in MUSCLES) if b not in ELSEWHERE]
    length = {b: np.linalg.norm(displaced(**{b: 1.0}), axis=1) for b in bases}
    for a, b in itertools.combinations(bases, 2):
        over = np.linalg.norm(displaced(**{a: 1.0, b: 1.0}), axis=1) - np.maximum(length[a], length[b])
        assert over.max() <= EXCESS + 1e-9, (a, b)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("risorius", "triangularis"),
        (PRESSER, "mentalis"),
        ("orbicularis_oculi_orbitalis", "orbicularis_oculi_palpebralis"),
    ],
)
def test_what_two_muscles_move_together_needs_both_in_part(displaced, head, first, second):
    joint = np.zeros_like(head.rest)
    for pair, field in head.joint.items():
        if {name.partition(".")[0] for name in pair} == {first, second}:
            joint[field.vertices] += field.displacement
    assert np.linalg.norm(joint, axis=1).max() > 2.0
    plain = replace(head, joint={})
    shares = []
    for a, b in ((0.0, 1.0), (1.0, 0.0), (0.1, 0.3), (HALF, HALF), (0.3, 0.3), (1.0, 1.0)):
        added = displaced(**{first: a, second: b}) - moved(plain, **{first: a, second: b})
        shares.append(float((added * joint).sum() / (joint * joint).sum()))
    assert shares[:2] == [0.0, 0.0]
    assert 0.2 < shares[2] < shares[3] < shares[4] < 0.8
    full = 1.0 - YIELDS.get((first, second), 0.0)  # those that yield to each other never contract fully
    assert shares[5] == pytest.approx(joint_share(full, full), abs=0.2)


def test_a_side_alone_leaves_the_joint_field_of_the_other(displaced):
    found = displaced(**{"risorius.left": 0.3, "triangularis.right": 0.3})
    apart = displaced(**{"risorius.left": 0.3}) + displaced(**{"triangularis.right": 0.3})
    assert np.abs(found - apart).max() < 0.5


def test_more_joint_fields_than_there_are_bits_are_refused(head):
    field = next(iter(head.joint.values()))
    many = {(first.name, second.name): field for first, second in itertools.combinations(MUSCLES[:8], 2)}
    with pytest.raises(HeadError, match="28 joint fields; expected at most 18"):
        MuscleFields.of(replace(head, joint=many))


def test_the_cap_sets_in_without_a_jump(displaced):
    steps = np.linspace(0.0, 1.0, 81)
    course = np.stack([displaced(zygomatic_major=1.0, risorius=a, orbicularis_oris_presser=a) for a in steps])
    speed = np.linalg.norm(np.diff(course, axis=0), axis=2)
    assert np.abs(np.diff(speed, axis=0)).max() < 0.1


def test_opposite_pulls_cancel_and_the_sum_is_never_longer_than_the_plain_one(displaced, head):
    a, b = "frontalis_medialis", "corrugator_supercilii"
    plain = np.linalg.norm(dense(head, f"{a}.left", f"{b}.left"), axis=1)
    together = np.linalg.norm(displaced(**{f"{a}.left": 1.0, f"{b}.left": 1.0}), axis=1)
    assert (together <= plain + 1e-9).all()


def test_sources_stand_in_the_table(head):
    fields = MuscleFields.of(head)
    assert (np.diff(fields.start) >= 0).all()
    assert INDEX["lip_tuck"] in fields.parameter
    assert INDEX["masseter"] not in fields.parameter
