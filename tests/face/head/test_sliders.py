"""Sliders change any head's shape, and leave its mouth and eyes as they are."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.errors import HeadError
from risorius.face.head.head import load_head, shipped_heads
from risorius.face.head.sliders import check_sliders, load_sliders, parse_slider, slider_names
from tests.profiles import everyday

from ..laws import Laws

BY_SIZE = {"face_length": 9.0, "fullness": 7.0, "nose_width": 3.0, "chin_length": 9.0, "ear_size": 9.0}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nose_widht:0.5", r"unknown slider 'nose_widht'.*nose_width"),
        ("nose_width:1.5", r"nose_width = 1\.5 is out of range; expected -1 to 1"),
        ("nose_width:nan", r"out of range"),
        ("nose_width", r"not a slider with its amount; expected e\.g\. nose_width:0\.5"),
        ("nose_width:much", r"not a slider with its amount"),
        ("", r"not a slider with its amount"),
    ],
)
def test_what_is_no_slider_is_an_error_that_says_why(text, message):
    with pytest.raises(HeadError, match=message):
        parse_slider(text)


def test_an_amount_is_read_with_its_name():
    assert parse_slider("chin_length:-0.5") == ("chin_length", -0.5)
    check_sliders(dict.fromkeys(slider_names(), 1.0))


def test_no_amount_is_the_head_itself(head):
    assert head.shaped({}) is head
    assert head.shaped({"nose_width": 0.0}) is head
    assert load_head(shape={"cheeks": 0.5}) is load_head(shape={"cheeks": 0.5})


@pytest.mark.parametrize("name", slider_names())
def test_a_slider_moves_the_skin_evenly_and_at_most_a_centimetre(head, name):
    for amount in (1.0, -1.0):
        change = head.shaped({name: amount}).rest - head.rest
        most = np.linalg.norm(change, axis=1).max()
        assert BY_SIZE.get(name, 2.0) < most < 10.1
        half = head.shaped({name: 0.5 * amount}).rest - head.rest
        np.testing.assert_allclose(half, 0.5 * change, atol=1e-9)
        mirrored = change[head.mirror] * [-1.0, 1.0, 1.0]
        assert np.abs(change - mirrored).max() < 0.05


def test_sliders_add_up(head):
    amounts = {"face_width": 0.7, "chin_length": -0.4}
    both = head.shaped(amounts).rest - head.rest
    alone = sum(head.shaped({name: amount}).rest - head.rest for name, amount in amounts.items())
    np.testing.assert_allclose(both, alone, atol=1e-9)


@pytest.mark.parametrize("name", ["face_length", "face_width", "jaw_width", "nose_length"])
def test_lips_and_lids_keep_their_form_and_what_belongs_to_them_goes_along(head, name):
    shaped = head.shaped({name: 1.0})
    mouth = shaped.teeth_upper.vertices - head.teeth_upper.vertices
    for way in (
        (shaped.rest - head.rest)[head.lip_pairs.ravel()],
        shaped.teeth_lower.vertices - head.teeth_lower.vertices,
        shaped.tongue.rest - head.tongue.rest,
        (shaped.jaw_point - head.jaw_point)[None],
    ):
        np.testing.assert_allclose(way, np.broadcast_to(mouth[0], way.shape), atol=0.03)
    for eye, pairs in enumerate(head.lid_pairs):
        lids = (shaped.skin.matrix @ (shaped.rest - head.rest))[pairs.ravel()]
        way = shaped.eye_centre[eye] - head.eye_centre[eye]
        np.testing.assert_allclose(lids, np.broadcast_to(way, lids.shape), atol=0.03)


@pytest.mark.parametrize("name", everyday(["standard", "olaf"], ["standard"]))
def test_the_laws_of_the_face_hold_on_another_shape(name):
    laws = Laws(load_head(name, shape={"face_length": 1.0, "fullness": 1.0, "jaw_width": 1.0}))
    overlap = 0.1 if name == "standard" else 0.3
    for targets in ({"AU12": 1.0}, {"AU16": 1.0, "AU22": 1.0}, {"AU17": 1.0, "AU24": 1.0}):
        assert laws.overlap(targets) <= overlap
        assert laws.opening(targets | {"masseter": 0.2, "lip_seal": 1.0}) <= 0.05
    assert laws.lids_apart() <= 0.01
    assert laws.lid_clearance() > 0.0


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["amara"]))
def test_every_shipped_head_can_be_shaped(name):
    assert len(load_head(name, shape={"nose_width": 1.0}).rest) == load_sliders().skin.shape[2]
