from __future__ import annotations

import itertools

import numpy as np
import pytest

from risorius.face.contact.lids import LOWER_GAIN, LOWER_MOST, follow
from risorius.face.head.eyes import pitch_and_yaw

BLINK = "orbicularis_oculi_palpebralis"
COMPANY = [
    {},
    {"levator_palpebrae": 1.0},
    {"orbicularis_oculi_orbitalis": 1.0},
    {"AU4": 1.0},
    {"AU1": 1.0, "AU2": 1.0, "levator_palpebrae": 1.0},
    {"AU6": 1.0, "AU9": 1.0, "AU12": 1.0, "AU4": 1.0},
    {"gaze_pitch": 30.0},
    {"gaze_pitch": -30.0, "levator_palpebrae": 0.5},
]


@pytest.fixture(scope="module")
def neighbours(head):
    found = {}
    for a, b in np.vstack([head.skin.quads[:, [k, (k + 1) % 4]] for k in range(4)]).tolist():
        found.setdefault(a, set()).add(b)
        found.setdefault(b, set()).add(a)
    return found


def margin(chain, neighbours):
    """The level-1 vertices along neighbouring level-0 vertices, with those between."""
    between = [min(neighbours[a] & neighbours[b]) for a, b in itertools.pairwise(chain)]
    return [v for pair in zip(chain, [*between, None], strict=True) for v in pair if v is not None]


def apart(frame, head, eye, neighbours):
    """Distance (k,) between the margins' points of one eye."""
    upper, lower = (margin(chain, neighbours) for chain in head.lid_pairs[eye].T.tolist())
    return np.linalg.norm(frame.skin[upper] - frame.skin[lower], axis=1)


def clearance(frame, head, eye, vertices):
    return np.linalg.norm(frame.skin[vertices] - head.eye_centre[eye], axis=1) - head.eye_radius[eye]


@pytest.mark.parametrize("company", COMPANY)
def test_closed_lids_meet_whatever_else_acts(face, head, neighbours, company):
    frame = face(**company, **{BLINK: 1.0})
    for eye in (0, 1):
        assert apart(frame, head, eye, neighbours).max() < 0.01


@pytest.mark.parametrize("company", COMPANY)
def test_the_aperture_shrinks_in_proportion(face, head, neighbours, company):
    opened = apart(face(**company), head, 0, neighbours)
    middle = opened > 0.8 * opened.max()
    for closure in (0.25, 0.5, 0.75):
        here = apart(face(**company, **{BLINK: closure}), head, 0, neighbours)
        np.testing.assert_allclose(here[middle] / opened[middle], 1.0 - closure, atol=0.08)


@pytest.mark.parametrize("company", COMPANY)
@pytest.mark.parametrize("closure", [0.0, 0.3, 0.6, 0.9, 1.0])
def test_lids_never_pierce_the_eyeball(face, head, rest, company, closure):
    frame = face(**company, **{BLINK: closure})
    for eye in (0, 1):
        start = np.linalg.norm(rest - head.eye_centre[eye], axis=1) - head.eye_radius[eye]
        before = rest[:, 2] > 0.2 * head.eye_radius[eye]
        outside = np.flatnonzero((start > 0.3) & (start < 6.0) & before)
        assert clearance(frame, head, eye, outside).min() > 0.25


def test_each_eye_closes_by_itself(face, head, neighbours):
    wink = face(**{f"{BLINK}.left": 1.0})
    opened = face()
    assert apart(wink, head, 0, neighbours).max() < 0.01
    np.testing.assert_allclose(
        apart(wink, head, 1, neighbours), apart(opened, head, 1, neighbours), atol=0.02
    )


def test_lids_stay_in_order_when_the_cheek_pushes_them_together(face, head):
    frame = face(AU6=1.0, AU4=1.0, AU9=1.0, **{BLINK: 0.35})
    upper, lower = frame.skin[head.lid_pairs[0]].transpose(1, 0, 2)
    assert (upper[:, 1] - lower[:, 1]).min() > -0.01


@pytest.mark.parametrize("pitch", [-25.0, -12.0, 12.0, 25.0])
def test_the_upper_lid_follows_the_gaze_and_the_lower_a_little_less(face, head, pitch):
    middle = head.lid_pairs[0][len(head.lid_pairs[0]) // 2]
    moved = (face(gaze_pitch=pitch).skin - face().skin)[middle, 1]
    assert np.sign(moved).tolist() == [np.sign(pitch)] * 2
    assert abs(moved[0]) > abs(moved[1]) > 0.5


def test_horizontal_gaze_leaves_the_lids_alone(face):
    assert np.abs(face(gaze_yaw=30.0).skin - face().skin).max() < 0.1


@pytest.mark.parametrize("pitch", [-30.0, 0.0, 15.0])
def test_the_lower_lid_keeps_near_the_iris(face, head, pitch):
    frame = face(gaze_pitch=pitch, gaze_distance=100.0)
    lower = frame.skin[head.lid_pairs[0][len(head.lid_pairs[0]) // 2, 1]] - head.eye_centre[0]
    lid = np.degrees(np.arctan2(lower[1], lower[2]))
    iris = pitch_and_yaw(frame.eye_rotation[0])[0] - np.degrees(np.arcsin(5.9 / 15.6))
    assert abs(lid - iris) < 20.0


def test_following_is_odd_about_rest_in_sign_and_bounded():
    assert follow(0.0, LOWER_GAIN, LOWER_MOST) == 0.0
    assert 0.0 < follow(35.0, LOWER_GAIN, LOWER_MOST) < np.radians(LOWER_MOST["up"])
    assert 0.0 > follow(-35.0, LOWER_GAIN, LOWER_MOST) > -np.radians(LOWER_MOST["down"])
