"""Blood moves with the skin: what gathers it reddens, what presses it out pales."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial import cKDTree

from risorius.face.head.head import load_head
from risorius.face.skin.wrinkle_regions import place_regions
from risorius.face.solve import FaceSolver
from risorius.looks.attributes import ALBEDO
from risorius.looks.head_model import head_model
from risorius.looks.perfusion import Perfusion
from risorius.rules.poses import pose_values


class Skin:
    """The colours of one head's skin in poses, as shares (N1, 3) of those at rest."""

    def __init__(self, head, flush=1.0):
        model = head_model(head)
        self.attributes = model.solids["skin"].attributes
        looks = replace(model.looks, flush=flush)
        self.perfusion = Perfusion(head, looks, self.attributes[:, ALBEDO : ALBEDO + 3])
        self.solver = FaceSolver(head)

    def change(self, pose):
        painted = self.attributes.copy()
        self.perfusion.colour(self.solver.solve(pose_values(pose, {})), painted)
        np.testing.assert_array_equal(painted[:, ALBEDO + 3 :], self.attributes[:, ALBEDO + 3 :])
        return painted[:, ALBEDO : ALBEDO + 3] / self.attributes[:, ALBEDO : ALBEDO + 3]


@pytest.fixture(scope="module")
def skin():
    return Skin(load_head("standard"))


def mean_of(head, change, about, radius):
    rest = head.skin.matrix @ head.rest
    return change[np.linalg.norm(rest - about, axis=1) < radius].mean(axis=0)


def test_skin_at_rest_has_its_own_colour(skin):
    np.testing.assert_allclose(skin.change({}), 1.0, atol=1e-4)


def test_cheeks_redden_as_a_smile_bunches_them(skin):
    red, green, blue = mean_of(skin.solver.head, skin.change({"AU6": 1.0, "AU12": 1.0}), (38, -38, 12), 8.0)
    assert green < 0.97
    assert blue < 0.975
    assert red > green + 0.02


def test_pressed_lips_pale_the_more_the_harder(skin):
    head = skin.solver.head
    lips = (head.skin.matrix @ head.masks["lips"] > 0.9) & (
        head.skin.matrix @ head.masks["inner_mouth"] < 0.05
    )
    green = [skin.change({"orbicularis_oris_presser": p})[lips, 1].mean() for p in (0.0, 0.05, 0.2, 0.5, 1.0)]
    assert (np.diff(green) > 0.0).all()
    assert green[1] < 1.06  # a /p/ hardly presses
    assert 1.15 < green[-1] < 1.45


def test_raised_brows_pale_the_ridges_of_the_forehead(skin):
    folding = next(p.zone.mask for p in place_regions(skin.solver.head) if p.region.name == "forehead")
    change = skin.change({"AU1": 1.0, "AU2": 1.0})
    assert change[folding > 0.9, 1].mean() > 1.005


def test_frowning_reddens_the_skin_between_the_brows(skin):
    assert mean_of(skin.solver.head, skin.change({"AU4": 1.0}), (0, 14, 27), 6.0)[1] < 0.99


def test_folds_between_brows_that_are_raised_and_drawn_together_are_not_red(skin):
    folding = next(p.zone.mask for p in place_regions(skin.solver.head) if p.region.name == "glabella")
    change = skin.change({"AU1": 1.0, "corrugator_supercilii": 0.9})
    assert change[folding > 0.8, 1].mean() > 0.99


def test_both_sides_change_alike(skin):
    rest = skin.solver.head.skin.matrix @ skin.solver.head.rest
    fine_mirror = cKDTree(rest).query(rest * [-1.0, 1.0, 1.0])[1]
    change = skin.change({"AU6": 1.0, "AU12": 1.0, "AU24": 0.5})
    np.testing.assert_allclose(change[fine_mirror], change, atol=2e-3)


def test_colours_stay_close_to_those_at_rest_without_spots(skin):
    head = skin.solver.head
    change = skin.change({"AU9": 1.0, "AU12": 1.0, "AU17": 1.0})
    assert change.min() > 0.85
    assert change.max() < 1.2
    pairs = np.vstack([head.skin.quads[:, [k, (k + 1) % 4]] for k in range(4)])
    assert np.abs(change[pairs[:, 0]] - change[pairs[:, 1]]).max() < 0.06


def test_a_head_that_does_not_flush_keeps_its_colour():
    pale = Skin(load_head("standard"), flush=0.0)
    np.testing.assert_array_equal(pale.change({"AU12": 1.0, "AU28": 1.0}), 1.0)


def test_clones_work_apart(skin):
    other = skin.perfusion.clone()
    smile = skin.solver.solve(pose_values({"AU12": 1.0}, {}))
    first, second = skin.attributes.copy(), skin.attributes.copy()
    skin.perfusion.colour(smile, first)
    other.colour(skin.solver.solve(pose_values({"AU4": 1.0}, {})), second)
    skin.perfusion.colour(smile, second)
    np.testing.assert_array_equal(first, second)
