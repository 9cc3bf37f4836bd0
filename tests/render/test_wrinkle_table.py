"""Wrinkles as the renderer draws them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from risorius.core.action_units import resolve_targets
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.head.head import load_head
from risorius.face.skin.wrinkle_layouts import Fold
from risorius.face.skin.wrinkle_regions import place_regions, region_names
from risorius.face.solve import FaceSolver
from risorius.looks.head_model import head_model
from risorius.render.materials.wrinkle_normals import pit, ridge
from risorius.render.software_renderer import SoftwareRenderer
from risorius.render.wrinkle_table import DIMPLES, FOLD, FURROW, KIND, SHARE, lay_creases

SIDE = 720


@pytest.fixture(scope="module")
def head():
    return load_head("standard")


@pytest.fixture(scope="module")
def surprised(head):
    values = np.array(NEUTRAL)
    for name, value in resolve_targets({"AU1": 1.0, "AU2": 1.0}).items():
        values[INDEX[name]] = value
    return FaceSolver(head, age=70.0).solve(values)


@pytest.fixture(scope="module")
def renderer(head):
    return SoftwareRenderer(head_model(head), (SIDE, SIDE))


def picture(renderer, frame):
    return renderer.render(frame).astype(int)


def test_regions_are_laid_out_where_the_face_has_them(head):
    count = len(head.skin.triangles) + 7
    creases = lay_creases(head, count)
    assert creases.regions.shape == (count,)
    assert not creases.regions[-7:].any()
    for k, placed in enumerate(place_regions(head)):
        covered = (creases.regions[:-7] >> k) & 1
        inside = (placed.zone.mask > 0.0)[head.skin.triangles]
        np.testing.assert_array_equal(covered, inside.any(axis=1))


def test_slopes_lie_in_the_skin_and_count_creases(head):
    creases, placed = lay_creases(head, len(head.skin.triangles)), place_regions(head)
    k = region_names().index("forehead")
    well_within = (placed[k].zone.mask > 0.5) & (creases.place[:, k, 0] > 0.0)
    steep = np.linalg.norm(creases.place[well_within, k, 1:], axis=1)
    assert np.median(1.0 / steep) == pytest.approx(placed[k].region.layout.spacing, rel=0.15)


def test_every_style_says_how_it_is_drawn(head):
    creases = lay_creases(head, len(head.skin.triangles))
    for style, placed in zip(creases.style, place_regions(head), strict=True):
        assert (style[KIND] == FOLD) == isinstance(placed.region.layout, Fold)
        assert style[FURROW] > 0.3
        assert 0.4 <= style[SHARE] <= 1.0
    assert creases.style[region_names().index("chin"), KIND] == DIMPLES


def test_folds_are_seen_where_they_are_and_nowhere_else(renderer, surprised):
    bare = replace(surprised, wrinkles=np.zeros_like(surprised.wrinkles))
    forehead = replace(surprised, wrinkles=surprised.wrinkles.copy())
    forehead.wrinkles[:, 1:] = 0.0
    change = np.abs(picture(renderer, forehead) - picture(renderer, bare)).max(axis=2)
    above_brows = change[: int(0.36 * SIDE)]
    assert (above_brows > 8).sum() > 500
    assert change[int(0.40 * SIDE) :].max() == 0


def test_shading_grows_gradually_with_height(renderer, surprised):
    """A fold of no height changes nothing, and a small step in height is a small step in every pixel."""
    frames = [replace(surprised, wrinkles=surprised.wrinkles * s) for s in (0.0, 0.5, 0.52)]
    none, half, more = (picture(renderer, frame) for frame in frames)
    assert np.abs(half - none).max() > 10
    assert np.abs(more - half).max() < 6


def test_folds_finer_than_pixels_fade_instead_of_flickering(head, renderer, surprised):
    bare = replace(surprised, wrinkles=np.zeros_like(surprised.wrinkles))
    forehead = replace(bare, wrinkles=surprised.wrinkles * (np.arange(len(region_names())) == 0))
    small = SoftwareRenderer(head_model(head), (SIDE // 6, SIDE // 6))
    near, far = (np.abs(picture(r, forehead) - picture(r, bare)).max() for r in (renderer, small))
    assert near > 12
    assert far < 0.5 * near


def test_the_same_frame_gives_the_same_bytes(renderer, surprised):
    first = renderer.render(surprised)
    bare = replace(surprised, wrinkles=np.zeros_like(surprised.wrinkles))
    renderer.render(bare)
    np.testing.assert_array_equal(first, renderer.render(surprised))


def test_a_frown_is_a_soft_fold_and_no_scratch():
    """Its bottom is round: beside it the slope rises to a side that is lit, not at once."""
    furrow, spacing, fine = np.float32(2.4), np.float32(9.0), np.float32(0.05)
    slopes = {d: ridge(np.float32(d), spacing, furrow, fine)[0] for d in (-0.7, 0.1, 0.7)}
    assert slopes[-0.7] == pytest.approx(-slopes[0.7])
    assert slopes[0.1] < 0.5 * slopes[0.7]


def test_a_crease_is_darkest_and_quite_dark_at_its_bottom():
    dark = [ridge(np.float32(d), *(np.float32(n) for n in (8.2, 1.1, 0.05)))[1] for d in (0.0, 0.5, 2.0)]
    assert dark[0] == pytest.approx(1.0, abs=0.01)
    assert dark[0] > dark[1] > dark[2]
    assert dark[2] < 0.1


def test_pits_of_the_chin_have_no_edge():
    """A hard edge between pit and hill looks like the peel of an orange."""
    heights = np.linspace(-0.95, 0.95, 39, dtype=np.float32)
    shares = [pit(h, np.float32(4.0), np.float32(0.1))[0] for h in heights]
    steps = np.diff(shares)
    assert (steps < 0.0).all()
    assert steps.min() == pytest.approx(steps.max(), rel=0.01)
