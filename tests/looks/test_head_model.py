from dataclasses import replace

import numpy as np
import pytest

from risorius.looks.attributes import ATTRIBUTES, HAIR
from risorius.looks.head_model import head_model
from risorius.looks.srgb import linear

SOLIDS = ["skin", "eye_left", "eye_right", "teeth_upper", "teeth_lower", "tongue"]


@pytest.fixture(scope="module")
def model(head):
    return head_model(head)


@pytest.fixture(scope="module")
def parts(model):
    return model.parts()


def test_the_solids_stand_before_the_hairs(parts):
    assert list(parts) == [*SOLIDS, "brows", "lashes", "hair", "hairline"]
    assert all(part.name == name for name, part in parts.items())
    assert [name for name, part in parts.items() if part.two_sided] == ["brows", "lashes", "hair", "hairline"]


def test_a_bald_head_has_brows_and_lashes_alone(head):
    model = head_model(head, replace(head.identity.looks, hair_style="bald"))
    assert list(model.hairs) == ["brows", "lashes"]


def test_all_arrays_of_a_part_fit_each_other(parts):
    for part in parts.values():
        count = len(part.points)
        assert part.attributes.shape == (count, ATTRIBUTES)
        assert part.colours.shape == (count, 3)
        assert part.colours.min() >= 0
        assert part.colours.max() <= 1
        for corners in (part.triangles, part.faces):
            assert corners.min() >= 0
            assert corners.max() < count
        assert set(np.unique(part.triangles)) == set(np.unique(part.faces))


def test_hairs_go_along_with_points_of_the_skin(parts):
    hair = parts["hair"]
    assert hair.surface == HAIR
    assert hair.weights.sum(axis=1) == pytest.approx(np.ones(len(hair.points)), abs=1e-6)
    assert hair.roots.max() < len(parts["skin"].points)


def test_the_skin_has_the_colour_of_the_cloth_below_the_neckline_alone(model, parts):
    skin, colours = parts["skin"], parts["skin"].colours
    cloth = np.abs(colours - linear(model.looks.cloth)).max(axis=1) < 1e-9
    assert cloth[np.abs(skin.points[:, 0]) > 120].all()
    assert not cloth[skin.points[:, 1] > model.anatomy.chin].any()


def test_other_looks_change_colours_and_no_shape(head, model):
    other = head_model(head, replace(head.identity.looks, skin=(92, 60, 46)))
    assert np.array_equal(other.solids["skin"].points, model.solids["skin"].points)
    assert other.solids["skin"].colours.mean() < 0.6 * model.solids["skin"].colours.mean()
