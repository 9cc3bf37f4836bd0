from __future__ import annotations

import math
import shutil
from pathlib import Path

import numpy as np
import pytest

import risorius.heads
from risorius.errors import HeadError
from risorius.face.head.head import load_head, shipped_heads
from tests.profiles import everyday

HEADS = Path(next(iter(risorius.heads.__path__)))


@pytest.mark.parametrize("age", [-1.0, 101.0, math.nan])
def test_an_age_out_of_range(age):
    with pytest.raises(HeadError, match="expected 0 to 100 years"):
        load_head("standard", age=age)


def test_a_head_without_ages(tmp_path):
    shutil.copy(HEADS / "standard" / "head.npz", tmp_path)
    head = load_head(tmp_path)
    assert head.aged(25.0) is head
    with pytest.raises(HeadError, match=r"has no other ages \(ages\.npz is missing"):
        head.aged(60.0)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("years", np.array([25.0, 120.0]), "spans 25 to 120"),
        ("years", np.array([90.0, 25.0]), "does not ascend"),
        ("years", np.array([30.0, 90.0]), "lacks the head's own age 25"),
        ("mouth", np.zeros((3, 3)), r"has shape \(3, 3\); expected \(2, 3\)"),
        ("rest/1/vertices", np.array([60000], np.uint16), "points outside"),
        ("eye_radius", None, "is missing"),
    ],
)
def test_a_wrong_array(tmp_path, name, value, message):
    for file in ("head.npz", "identity.toml"):
        shutil.copy(HEADS / "standard" / file, tmp_path)
    with np.load(HEADS / "standard" / "ages.npz") as archive:
        arrays = {key: archive[key] for key in archive.files}
    if value is None:
        del arrays[name]
    else:
        arrays[name] = value
    np.savez(tmp_path / "ages.npz", **arrays)
    with pytest.raises(HeadError, match=message) as caught:
        load_head(tmp_path)
    assert f"array '{name}'" in str(caught.value)


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["standard"]))
def test_its_own_age_changes_nothing(name):
    head = load_head(name)
    assert load_head(name, age=head.identity.age) is head
    assert np.abs(head.aged(40.0).aged(head.identity.age).rest - head.rest).max() < 1e-9


def test_shapes_change_evenly_and_stay_at_their_ends():
    head = load_head("standard")
    skins = [head.aged(age).rest for age in (25.0, 40.0, 55.0, 90.0)]
    np.testing.assert_allclose(skins[2] - skins[1], skins[1] - skins[0], atol=1e-9)
    assert np.abs(skins[3] - skins[0]).max() > 3.0
    np.testing.assert_array_equal(head.aged(0.0).rest, head.rest)
    np.testing.assert_array_equal(head.aged(100.0).rest, skins[3])


def test_the_mouth_goes_with_the_lips():
    young, old = load_head("olaf", age=25), load_head("olaf", age=90)
    lips = (old.rest - young.rest)[young.lip_pairs].mean(axis=(0, 1))
    for one, other in (
        (young.teeth_upper.vertices, old.teeth_upper.vertices),
        (young.tongue.rest, old.tongue.rest),
    ):
        assert np.abs((other - one).mean(axis=0) - lips).max() < 1.0
    assert old.identity.age == 90.0


def test_aged_arrays_are_read_only():
    head = load_head("ines", age=70)
    assert not any(a.flags.writeable for a in (head.rest, head.eye_centre, head.teeth_upper.vertices))
