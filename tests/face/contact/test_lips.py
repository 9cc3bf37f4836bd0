from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.lips.articulators import SEAL_MM
from risorius.face.contact.contact import Contacts, find_contacts
from risorius.face.contact.mouth import Mouth, TeethEdge
from risorius.face.contact.plate import nearby, plate_compliance
from risorius.face.fit.measure import Gauge
from tests.profiles import examples

from ..conftest import EMOTIONS, MOUTH_MUSCLES, values_of
from ..winding import LipTester

TOLERANCE = 0.1  # mm that lips may overlap
SEALED = 0.05  # mm that may stay open in a closure
PAIRS = list(itertools.combinations(MOUTH_MUSCLES, 2))


@pytest.fixture(scope="module")
def tester(head):
    return LipTester.of(head)


@pytest.fixture(scope="module")
def opening(head):
    """A function from a frame to the widest of the narrowest openings (mm) along the mouth."""
    mouth = Mouth.of(head)
    found = Contacts.allocate(len(mouth.facing.vertices))
    middle = 0.5 * np.abs(mouth.line)

    def widest(frame):
        points = frame.skin[mouth.vertices].astype(np.float64)
        count = find_contacts(mouth.facing, points, np.inf, found)
        stations = middle @ points[:, 0]
        x, gap = found.x[:count], found.gap[:count]
        places = np.linspace(stations[0], stations[-1], 40)
        about = [np.abs(x - place) < 0.06 * (stations[-1] - stations[0]) / 2.0 for place in places]
        return max(gap[near].min() for near in about if near.any())

    return widest


@pytest.mark.parametrize("muscle", MOUTH_MUSCLES)
def test_lips_do_not_pass_through_each_other_for_any_muscle(face, tester, muscle):
    assert tester.overlap(face(**{muscle: 1.0}).skin) < TOLERANCE


@pytest.mark.parametrize(("a", "b"), PAIRS[::5])
def test_lips_do_not_pass_through_each_other_for_pairs(face, tester, a, b):
    assert tester.overlap(face(**{a: 1.0, b: 1.0}).skin) < TOLERANCE


@given(
    st.dictionaries(st.sampled_from(MOUTH_MUSCLES), st.floats(0.0, 1.0), max_size=5),
    st.floats(0.0, 0.2),
    st.sampled_from([0.0, 0.5, 1.0]),
)
@examples(15, derandomize=True)
def test_lips_do_not_pass_through_each_other_in_random_poses(face, tester, muscles, jaw, seal):
    assert tester.overlap(face(**muscles, masseter=jaw, lip_seal=seal).skin) < TOLERANCE


@pytest.mark.parametrize("jaw", [0.0, 0.1, 0.2])
@pytest.mark.parametrize("emotion", EMOTIONS)
def test_a_seal_closes_the_whole_mouth_under_every_emotion(face, opening, tester, emotion, jaw):
    targets = EMOTIONS[emotion]
    sealed = face(**targets, masseter=jaw, lip_seal=1.0)
    assert opening(sealed) < SEALED
    assert tester.overlap(sealed.skin) < TOLERANCE


@pytest.mark.parametrize("emotion", ["happiness", "surprise", "fear"])
def test_a_seal_takes_so_many_millimetres_from_the_gap(face, head, emotion):
    gauge, seals = Gauge(head), np.array([0.0, 0.25, 0.5, 0.75, 0.9, 1.0])
    gap = [gauge.measure(face(**EMOTIONS[emotion], masseter=0.2, lip_seal=seal)).lip_gap_mm for seal in seals]
    assert gap[0] > 2.0
    expected = np.maximum(gap[0] - SEAL_MM * seals, 0.0) * (seals < 1.0)
    np.testing.assert_allclose(gap, expected, atol=0.9)


@pytest.mark.parametrize("tuck", [0.0, 0.1, 0.5])
def test_a_seal_begins_without_a_step(face, head, tuck):
    gauge, wide = Gauge(head), {"depressor_labii": 0.2, "levator_labii_superioris": 0.05, "masseter": 0.3}
    before, after = (
        gauge.measure(face(**wide, lip_tuck=tuck, lip_seal=seal)).lip_gap_mm for seal in (0.0, 0.002)
    )
    assert abs(before - after) < 0.1


def test_corners_that_are_pushed_apart_leave_the_middle_in_place(face, head):
    gauge = Gauge(head)
    rounded, parted = (0.81, 0.09, 0.68), (0.56, 0.17, 0.62)
    gap = []
    for share in np.linspace(0.0, 1.0, 13):
        funneler, jaw, seal = (a + (b - a) * share for a, b in zip(rounded, parted, strict=True))
        gap.append(
            gauge.measure(face(orbicularis_oris_funneler=funneler, masseter=jaw, lip_seal=seal)).lip_gap_mm
        )
    assert gap[0] < 1.0 < 2.5 < gap[-1]
    assert np.abs(np.diff(gap, n=2)).max() < 0.25


def test_without_goals_open_lips_are_left_as_the_muscles_put_them(face, solver, head, rest):
    frame = face(depressor_labii=1.0)
    field = sum(
        (
            np.bincount(f.vertices, f.displacement[:, 1], len(head.rest))
            for f in (head.fields["depressor_labii.left"], head.fields["depressor_labii.right"])
        ),
        np.zeros(len(head.rest)),
    )
    lips = head.skin.matrix @ head.masks["lips"] > 0.999  # beyond them the skin bulges and folds besides
    assert lips.sum() > 100
    moved, expected = frame.skin[:, 1] - rest[:, 1], head.skin.matrix @ field
    np.testing.assert_allclose(moved[lips], expected[lips], atol=1e-3)


@pytest.mark.parametrize("emotion", [None, "happiness", "disgust", "fear"])
def test_the_tucked_lower_lip_meets_the_upper_teeth(face, head, emotion):
    frame = face(**EMOTIONS.get(emotion, {}), masseter=0.08, lip_tuck=1.0)
    mouth = Mouth.of(head)
    lip = np.maximum(-mouth.line, 0.0) @ frame.skin[mouth.vertices]
    lip = lip[np.abs(lip[:, 0]) < 8.0]
    y, z = TeethEdge.of(head.teeth_upper, 15.0, 16).at(lip[:, 0])
    assert len(lip) >= 5
    assert np.abs(lip[:, 1] - y).max() < 1.5
    assert np.abs(lip[:, 2] - z).max() < 2.5


def test_the_tucked_lip_touches_the_teeth_from_before(face, head):
    frame = face(masseter=0.08, lip_tuck=1.0)
    mouth = Mouth.of(head)
    lip = (np.maximum(-mouth.line, 0.0) @ frame.skin[mouth.vertices])[len(mouth.line) // 2]
    _, edge = TeethEdge.of(head.teeth_upper, 15.0, 16).at(lip[:1])
    assert 1.7 < lip[2] - edge[0] < 2.5


def test_the_tucked_lip_is_near_the_back_of_the_upper_lip(face, head):
    """At most 2 mm behind it (facts: lips-motion, 8); the lip itself is some 10 mm thick."""
    frame = face(masseter=0.08, lip_tuck=1.0)
    skin, (upper, lower) = frame.skin, Gauge(head).landmarks(frame)[[62, 66]]
    above = (skin[:, 1] > upper[1] + 0.5) & (skin[:, 1] < upper[1] + 6.0)
    behind = (np.abs(skin[:, 0]) < 1.2) & (skin[:, 2] < upper[2]) & (skin[:, 2] > lower[2] - 3.0)
    assert 0.0 < skin[above & behind, 2].min() - lower[2] < 2.0


def test_the_lip_gap_grows_with_the_jaw(face, head):
    gauge = Gauge(head)
    gap = [gauge.measure(face(masseter=jaw)).lip_gap_mm for jaw in np.linspace(0.0, 1.0, 11)]
    assert gap[0] == pytest.approx(0.0, abs=1e-5)
    assert (np.diff(gap) > 0.5).all()


PATHS = [
    (
        {"AU12": 0.6, "AU22": 0.4, "masseter": 0.12},
        {"AU12": 0.6, "AU22": 0.4, "masseter": 0.12, "lip_seal": 1.0},
    ),
    ({"masseter": 0.1, "lip_tuck": 1.0}, {"masseter": 0.1, "lip_seal": 1.0}),
    (
        {"AU15.right": 1.0, "AU24": 0.8, "masseter": 0.15, "lip_tuck": 1.0},
        {"AU15.left": 0.6, "lip_seal": 0.5},
    ),
    ({"AU22": 1.0, "masseter": 0.1}, {"AU24": 1.0, "AU17": 1.0}),
    ({"AU10": 1.0, "AU16": 1.0}, {"AU15": 1.0, "AU17": 1.0, "lip_tuck": 0.5}),
]


@pytest.mark.parametrize(("start", "end"), PATHS)
def test_nothing_jumps_on_the_way_from_one_pose_to_another(solver, head, start, end):
    a, b = values_of(start), values_of(end)
    skins = np.array([solver.solve(a + (b - a) * share).skin for share in np.linspace(0.0, 1.0, 61)])
    bend = np.linalg.norm(np.diff(skins, n=2, axis=0), axis=-1)
    lining = np.asarray(head.skin.matrix @ head.masks["inner_mouth"]) > 0.99
    assert bend[:, ~lining].max() < 0.5
    assert bend.max() < 0.55  # deep within the mouth


def test_sucked_lips_roll_in_and_stay_shut(face, head, opening):
    rest, sucked = face(), face(orbicularis_oris_presser=1.0)
    middles = [51, 57]
    ways = head.landmarks(sucked.skin)[middles] - head.landmarks(rest.skin)[middles]
    assert ways[0, 1] < -2.0
    assert ways[0, 2] < -5.0
    assert ways[1, 1] > 5.0
    assert opening(sucked) < 2 * SEALED


def test_rounded_lips_open_in_the_middle_alone(face, head):
    mouth = Mouth.of(head)
    frame = face(orbicularis_oris_funneler=0.8, masseter=0.05)
    points = frame.skin[mouth.vertices].astype(np.float64)
    found = Contacts.allocate(len(mouth.facing.vertices))
    count = find_contacts(mouth.facing, points, np.inf, found)
    half = 0.5 * float(np.ptp(head.landmarks(frame.skin)[[48, 54], 0]))
    x, gap = np.abs(found.x[:count]), found.gap[:count]
    assert gap[x < 0.1 * half].min() > 1.5
    assert gap[(x > 0.55 * half) & (x < 0.65 * half)].min() < 0.7


def test_single_precision_of_the_compliance_moves_no_point_by_a_hundred_thousandth(solver, head, monkeypatch):
    values = values_of({"lip_seal": 0.7, "mentalis": 0.4, "masseter": 0.1})
    single, mouth = solver.solve(values).skin, Mouth.of(head)
    near = nearby(head.rest, mouth.matrix @ head.rest)
    plate = plate_compliance(head.quads, mouth.matrix, near)
    monkeypatch.setattr(solver._lips, "_compliance", plate.compliance)
    assert np.abs(solver.solve(values).skin - single).max() < 1e-5


def test_corners_that_are_pushed_apart_do_not_move_the_middle_by_steps(solver, head):
    """Two frames of a rounded "brother" that are 25 ms apart, 25 times as slowly."""
    names = ("zygomatic_major", "orbicularis_oris_funneler", "masseter", "lip_seal")
    start, end = (0.14, 0.72, 0.31, 0.76), (0.15, 0.72, 0.32, 0.73)
    gauge, gaps = Gauge(head), []
    for share in np.linspace(0.0, 1.0, 26):
        pose = {name: a + (b - a) * share for name, a, b in zip(names, start, end, strict=True)}
        gaps.append(gauge.measure(solver.solve(values_of(pose))).lip_gap_mm)
    assert gaps[-1] - gaps[0] > 0.6
    assert np.diff(gaps).max() < 0.1
