"""Wrinkles: the arc-length law, and folds on the standard head."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.errors import InputError
from risorius.face.head.coupled_muscles import NO_LINKS
from risorius.face.head.face_coordinates import FaceCoordinates
from risorius.face.skin.wrinkle_regions import place_regions, region_names, regions
from risorius.face.skin.wrinkles import FLAT, LOW, Wrinkles, capped, fold_height
from risorius.face.solve import FaceSolver
from tests.profiles import examples

from ..conftest import values_of


def test_a_capped_height_is_the_hyperbolic_tangent_to_single_precision():
    heights = np.linspace(1e-6, 3.0, 3000)
    shares = np.concatenate([heights, LOW + np.array([-1e-9, 0.0, 1e-9])])
    assert [capped(1.5 * x, 1.5) for x in shares] == pytest.approx(1.5 * np.tanh(shares), rel=6e-8, abs=0.0)


SMILE = {"AU12": 0.9, "AU6": 0.9}
# What compresses each region, by action units.
PULLS = {
    "forehead": {"AU1": 1.0, "AU2": 1.0},
    "glabella": {"AU4": 1.0},
    "nose_root": {"AU4": 1.0},
    "bunny": {"AU9": 1.0},
    "crows_feet": {"AU6": 1.0},
    "under_eye": SMILE,
    "nasolabial": SMILE,
    "wing": SMILE,
    "sneer": {"AU9": 1.0},
    "marionette": {"AU15": 1.0},
    "chin": {"AU17": 1.0},
}
INDEX = {name: k for k, name in enumerate(region_names())}


@pytest.fixture(scope="module")
def young(head):
    return FaceSolver(head, age=20.0)


@pytest.fixture(scope="module")
def old(head):
    return FaceSolver(head, age=75.0)


def tallest(solver, targets):
    return solver.solve(values_of(targets)).wrinkles.max(axis=0)


@pytest.mark.parametrize("age", [-0.1, 101.0, float("nan")])
def test_an_age_out_of_range_is_named(head, age):
    with pytest.raises(InputError, match="age"):
        Wrinkles(head, age)


def test_a_region_that_does_not_exist_is_named(head):
    with pytest.raises(InputError, match="wrinkle region 'brow'"):
        Wrinkles(head, 40.0, {"brow": 1.0})


@given(stretch=st.floats(0.6, 0.9), give=st.floats(0.0, 0.07), width=st.floats(3.0, 15.0))
def test_a_fold_keeps_the_skin_s_length(stretch, give, width):
    height, chord = fold_height(width, stretch, give), width * stretch
    x = np.linspace(0.0, chord, 4001)
    fold = 0.5 * height * (1.0 - np.cos(2.0 * np.pi * x / chord))
    length = np.hypot(np.diff(x), np.diff(fold)).sum()
    excess = (1.0 - give) / stretch - 1.0
    # The closed form takes the arc to second order in h/d.
    assert length / chord - 1.0 == pytest.approx(excess, rel=0.05 + 0.55 * excess + FLAT / max(excess, FLAT))


@given(stretch=st.floats(0.3, 1.2), give=st.floats(0.0, 0.14))
def test_the_law_is_continuous_and_flat_where_skin_gives(stretch, give):
    height = fold_height(10.0, stretch, give)
    assert (height > 0.0) == ((1.0 - give) / stretch > 1.0)
    assert abs(fold_height(10.0, stretch + 1e-6, give) - height) < 5e-4


def test_nothing_folds_at_rest_while_young(young, rest):
    frame = young.solve(values_of({}))
    assert frame.wrinkles.shape == (len(rest), len(INDEX))
    assert frame.wrinkles.dtype == np.float32
    assert frame.wrinkles.max() < 1e-6
    np.testing.assert_allclose(frame.skin, rest, atol=2e-3)


def test_the_old_keep_creases_at_rest_that_do_not_move_the_mesh(old, rest):
    frame = old.solve(values_of({}))
    deepest = frame.wrinkles.max(axis=0)
    assert (deepest[[INDEX["forehead"], INDEX["crows_feet"], INDEX["nasolabial"]]] > 0.1).all()
    np.testing.assert_allclose(frame.skin, rest, atol=2e-3)


@pytest.mark.parametrize("region", INDEX)
def test_every_region_folds_under_its_muscles_and_deepens_with_age(region, young, old):
    k, cap = INDEX[region], regions()[INDEX[region]].sizes.cap
    fresh, worn = tallest(young, PULLS[region])[k], tallest(old, PULLS[region])[k]
    assert worn > fresh
    assert 0.25 * cap < worn <= 1.01 * cap


@pytest.mark.parametrize("region", INDEX)
def test_folds_grow_with_the_pull_without_jumps(region, old):
    k = INDEX[region]
    levels = np.linspace(0.0, 1.0, 41)
    heights = np.array([tallest(old, {n: a * v for n, v in PULLS[region].items()})[k] for a in levels])
    assert heights[-1] > heights[0] + 0.05
    assert np.abs(np.diff(heights)).max() < 0.25 * (heights.max() - heights.min())
    finer = np.array([tallest(old, {n: a * v for n, v in PULLS[region].items()})[k] for a in (0.5, 0.5005)])
    assert abs(finer[1] - finer[0]) < 0.01


def test_a_surprise_leaves_the_chin_and_cheeks_alone(old):
    moving = tallest(old, PULLS["forehead"]) - tallest(old, {})
    assert moving[INDEX["forehead"]] > 0.3
    elsewhere = [INDEX[name] for name in ("chin", "nasolabial", "marionette")]
    assert np.abs(moving[elsewhere]).max() < 0.05
    # Raised brows smooth the frown lines that stand at rest.
    assert moving[INDEX["glabella"]] < 0.05


def test_mentalis_alone_puckers_the_chin(young):
    assert tallest(young, {"mentalis": 1.0})[INDEX["chin"]] > 0.1
    for muscle in ("orbicularis_oris_funneler", "depressor_labii"):
        assert tallest(young, {muscle: 1.0})[INDEX["chin"]] == 0.0


def test_the_side_of_the_nose_folds_under_its_own_muscle_alone(old):
    still, bunny = tallest(old, {}), INDEX["bunny"]
    assert tallest(old, {**SMILE, "AU7": 1.0})[bunny] <= still[bunny] + 1e-6
    assert tallest(old, {"AU9": 0.5})[bunny] > 0.5


def test_a_young_forehead_folds_where_frontalis_ends_in_it(young):
    assert 0.1 < tallest(young, {"AU1": 0.3, "AU2": 0.3})[INDEX["forehead"]] < 0.3


def test_lifted_lips_fold_the_skin_beside_the_nose_though_the_cheek_rises_with_them(young):
    assert tallest(young, {"AU6": 0.4, "AU9": 0.9, "AU10": 0.5})[INDEX["sneer"]] > 0.4
    assert tallest(young, {"AU16": 1.0, "AU17": 1.0})[INDEX["sneer"]] == 0.0


def test_a_lip_that_one_side_lifts_folds_that_side_alone(young, rest):
    folds = young.solve(values_of({"AU10.left": 1.0})).wrinkles[:, INDEX["sneer"]]
    assert folds[rest[:, 0] > 10.0].max() > 0.4
    assert folds[rest[:, 0] < -10.0].max() < 0.05


def test_stretched_skin_folds_no_more_and_opens_its_creases(old):
    still, stretched = tallest(old, {}), tallest(old, {"masseter": 1.0})
    # The lower end of the nasolabial fold is pushed by the corner of the mouth; the cheek narrows beside it.
    rest_of_face = [k for name, k in INDEX.items() if name not in ("nasolabial", "sneer")]
    assert (stretched <= still + 0.02)[rest_of_face].all()
    assert stretched[INDEX["marionette"]] < 0.8 * still[INDEX["marionette"]]


def test_mirrored_pulls_make_mirrored_folds(old, fine_mirror):
    left = old.solve(values_of({"AU1.left": 1.0, "AU12.left": 0.8, "AU6.left": 1.0, "AU9.left": 0.5}))
    right = old.solve(values_of({"AU1.right": 1.0, "AU12.right": 0.8, "AU6.right": 1.0, "AU9.right": 0.5}))
    assert left.wrinkles.max() > 0.5
    np.testing.assert_allclose(left.wrinkles, right.wrinkles[fine_mirror], atol=5e-3)


def test_one_brow_wrinkles_its_own_side(head, rest):
    old = FaceSolver(head, NO_LINKS, age=70.0)
    wrinkles = old.solve(values_of({"AU1.left": 1.0, "AU2.left": 1.0})).wrinkles[:, INDEX["forehead"]]
    still = old.solve(values_of({})).wrinkles[:, INDEX["forehead"]]
    gained = wrinkles - still
    assert gained[rest[:, 0] > 12.0].max() > 0.3
    assert gained[rest[:, 0] < -25.0].max() < 0.1


def test_a_speaker_without_a_wrinkle_does_not_show_it(head, old):
    smooth = FaceSolver(head, age=75.0, wrinkles={"forehead": 0.0, "glabella": 0.5})
    assert tallest(smooth, PULLS["forehead"])[INDEX["forehead"]] == 0.0
    half, full = (tallest(s, PULLS["glabella"])[INDEX["glabella"]] for s in (smooth, old))
    assert 0.3 * full < half < 0.8 * full


def test_folding_the_same_skin_gives_the_same_bytes(old):
    first = old.solve(values_of(SMILE))
    old.solve(values_of({"AU4": 1.0}))
    again = old.solve(values_of(SMILE))
    assert first.wrinkles.tobytes() == again.wrinkles.tobytes()
    assert first.skin.tobytes() == again.skin.tobytes()


@examples(10, derandomize=True)
@given(st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6))
def test_any_face_keeps_its_folds_within_their_caps(old, strengths):
    units = dict(zip(("AU1", "AU4", "AU6", "AU9", "AU12", "AU15"), strengths, strict=True))
    caps = np.array([region.sizes.cap for region in regions()])
    heights = tallest(old, units)
    assert np.isfinite(heights).all()
    assert (heights <= 1.01 * caps).all()


def test_an_open_jaw_draws_the_folds_beside_the_nose_out(old):
    """It narrows the cheeks as it lengthens them: taut skin does not fold."""
    rest = tallest(old, {})
    for jaw in (0.3, 0.6, 1.0):
        opened = tallest(old, {"masseter": jaw}) - rest
        assert opened[INDEX["sneer"]] < 0.25
        assert opened[INDEX["wing"]] < 0.08
        assert opened[INDEX["nasolabial"]] < 0.35


def test_the_fold_of_a_smile_runs_from_the_noses_wing_to_below_the_corner_of_the_mouth(young, rest):
    """A fold that ends beside the corner lies there as a dent of its own."""
    placed, marks = place_regions(young.head)[INDEX["nasolabial"]], FaceCoordinates.of(young.head)
    heights = young.solve(values_of(SMILE)).wrinkles[:, INDEX["nasolabial"]]
    wing, corner = (marks.landmarks[k, 1] * marks.unit for k in (35, 54))
    on_crease = np.abs(placed.phase) < 0.06
    for level in np.linspace(wing, corner - 8.0, 6):
        near = on_crease & (np.abs(rest[:, 1] - level) < 4.0) & (rest[:, 0] > 0.0)
        assert heights[near].max() > 0.3, level


def test_a_fold_that_muscles_draw_in_opens_where_the_skin_is_stretched(old):
    """Creases beside the nose of old skin are shallower in an open mouth; the first pull makes no jump."""
    k, opened = INDEX["nasolabial"], {"masseter": 1.0, "AU16": 1.0}
    still, stretched = (old.solve(values_of(t)).wrinkles[:, k].copy() for t in ({}, opened))
    assert (still - stretched).max() > 0.05
    pulled = old.solve(values_of(opened | {"AU12": 1e-4})).wrinkles[:, k]
    assert np.abs(pulled - stretched).max() < 0.01
