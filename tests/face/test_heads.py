"""The laws of the face on every head that comes with Risorius, as made and at other ages."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from risorius.face.head.head import load_head, shipped_heads
from tests.profiles import everyday

from .conftest import EMOTIONS
from .laws import Laws, lid_heights

OVERLAP, SEALED, LIDS, CLEAR = 0.3, 0.05, 0.01, 0.25
PIERCED = 0.3
# Rounded lips press on each other at their sides, where contact holds them apart: on the fullest lips most.
OVERSHOOT, EXACT = 2.5, 0.995
# One corner of the mouth up, the other side of the lower lip down: the last places to close.
ASKEW = {"zygomatic_major.left": 0.93, "zygomatic_major.right": 0.5, "depressor_labii.left": 0.96}
TH = {"masseter": 0.11, "depressor_labii": 0.25, "tongue_up": 0.15, "tongue_out": 1.0}
HEADS = shipped_heads()
AGED = [("standard", 50), ("standard", 75), ("amara", 75), ("mei", 90), ("olaf", 25), ("kenji", 75)]
DAILY = [("amara", 75)]
PRESSED = {"orbicularis_oris_presser": 1.0, "mentalis": 1.0}
POSES = [
    {"zygomatic_major": 1.0, "levator_labii_nasi": 1.0},
    {"triangularis": 1.0, "mentalis": 1.0},
    {"orbicularis_oris_funneler": 1.0, "risorius": 0.6},
    {"orbicularis_oris_presser": 1.0, "zygomatic_minor": 0.5},
    {"levator_labii_superioris": 1.0, "depressor_labii": 1.0},
    PRESSED,
]
CROWDED = [  # a lip rolled in against the teeth and raised; lids that close under raised brows
    {"orbicularis_oris_presser": 1.0, "levator_labii_nasi": 1.0},
    {"orbicularis_oculi_palpebralis": 0.97, "frontalis_medialis": 0.8, "frontalis_lateralis": 0.6},
]


@pytest.fixture(scope="module", params=everyday([*((n, None) for n in HEADS), *AGED], DAILY), ids=str)
def laws(request):
    name, age = request.param
    return Laws(load_head(name, age=age))


def test_lips_are_together_at_rest(laws):
    assert laws.rest_gap() < 0.15
    assert laws.overlap({}) < 0.1


def test_lips_do_not_pass_through_each_other(laws):
    assert max(map(laws.overlap, POSES)) < OVERLAP


def test_pressed_lips_stay_shut_while_the_chin_rises(laws):
    assert laws.opening(PRESSED) < 0.4


def test_a_seal_closes_the_mouth(laws):
    for emotion, jaw in itertools.product(("happiness", "disgust", "fear"), (0.0, 0.2)):
        pose = EMOTIONS[emotion] | {"masseter": jaw, "lip_seal": 1.0}
        assert laws.opening(pose) < SEALED
        assert laws.overlap(pose) < OVERLAP


def test_a_seal_closes_the_mouth_whatever_the_jaw(laws):
    for jaw in (0.0, 0.05, 0.1, 0.15, 0.2):
        assert laws.opening({"masseter": jaw, "lip_seal": 1.0}) < SEALED


def test_a_seal_closes_a_mouth_that_is_askew(laws):
    assert laws.opening(ASKEW | {"masseter": 0.2, "lip_seal": 1.0}) < SEALED


def test_a_muscle_alone_gives_its_field_and_two_little_more_than_the_larger(laws):
    share, _ = laws.alone()
    assert share >= EXACT
    assert laws.overshoot() <= OVERSHOOT


def test_lids_meet_and_clear_the_eyeball(laws):
    assert laws.lids_apart() < LIDS
    assert laws.lid_clearance() > CLEAR


def test_the_tucked_lip_meets_the_teeth(laws):
    y, z = laws.tuck({"AU12": 1.0})
    assert y < 1.5
    assert z < 2.5


def test_no_outer_skin_turns_over(laws):
    assert not any(map(laws.turned, (*POSES, *CROWDED)))
    assert laws.turned({"masseter": 1.0}) == 0


def test_teeth_stand_behind_the_lips(laws):
    assert laws.teeth_in_lips() < -1.0


def test_the_tongue_shows_for_th(laws):
    assert laws.tongue_shown(TH) > 1.2
    assert laws.tongue_shown({**TH, "tongue_out": 0.0}) == 0.0
    assert max(laws.teeth_pierced(TH)) < PIERCED


def test_nothing_pierces_the_teeth_as_the_mouth_opens_wide(laws):
    for jaw in (0.5, 0.7, 1.0):
        assert max(laws.teeth_pierced({"masseter": jaw})) < PIERCED


@pytest.mark.parametrize("name", everyday(HEADS, ["kwame", "olaf"]))
@pytest.mark.parametrize("age", [None, 25.0, 60.0, 90.0])
def test_lids_stand_about_the_iris_as_those_of_people(name, age):
    upper, lower = lid_heights(load_head(name, age=age))
    assert 3.0 < upper < 4.6
    assert -6.4 < lower < -4.9


@pytest.mark.parametrize("name", everyday(HEADS, ["amara"]))
def test_heads_share_one_topology(name):
    head, standard = load_head(name), load_head("standard")
    np.testing.assert_array_equal(head.quads, standard.quads)
    np.testing.assert_array_equal(head.mirror, standard.mirror)
    np.testing.assert_array_equal(head.uv, standard.uv)
    assert np.abs(head.rest[head.mirror] * [-1.0, 1.0, 1.0] - head.rest).max() < 1e-4
    assert np.abs(head.eye_centre.mean(axis=0)).max() < 1e-6


@pytest.mark.parametrize("pair", everyday(itertools.combinations(HEADS, 2), [("amara", "standard")]), ids=str)
def test_heads_differ_clearly(pair):
    a, b = map(load_head, pair)
    apart = a.landmarks(a.skin.matrix @ a.rest) - b.landmarks(b.skin.matrix @ b.rest)
    assert np.linalg.norm(apart, axis=1).max() > 3.0
