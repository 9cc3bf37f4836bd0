"""The table of wrinkle regions, and where it lays them on a head."""

from __future__ import annotations

from importlib import resources

import numpy as np
import pytest

from risorius.errors import InputError
from risorius.face.skin.wrinkle_regions import (
    check_factors,
    parse_regions,
    place_regions,
    region_names,
    regions,
)

TEXT = (resources.files("risorius.face.skin") / "data" / "wrinkles.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("cap = ", "cup = "), "t.toml:25:1: unknown key 'forehead.cup'; did you mean 'cap'"),
        (
            ("static = 0.35\n", ""),
            "t.toml:23:1: key 'forehead.static' is missing; expected a number from 0 to 200",
        ),
        (
            ("[forehead.lines]", "[forehead.line]"),
            "t.toml:32:1: unknown key 'forehead.line'; did you mean 'lines'",
        ),
        (
            ("[forehead.lines]", "[lines.lines]"),
            "t.toml:23:1: has the layouts none; expected one of lines, fan",
        ),
        (("anchor = [19, 24]", "anchor = []"), "t.toml:33:1: there is no landmark; expected at least one"),
        (
            ("anchor = [19, 24]", "anchor = [68]"),
            "t.toml:33:11: forehead.lines.anchor[0] = 68 is out of range",
        ),
        (
            ("shadow = 1.0", "shadow = 8"),
            "t.toml:30:1: forehead.shadow = 8 is out of range; expected a number from 0",
        ),
        (
            ("bow = -0.0018", "bow = true"),
            "t.toml:41:1: forehead.lines.bow = true cannot be used; expected a number",
        ),
        (("[forehead]", "[forehead"), "t.toml:23:10: is not a TOML file"),
    ],
)
def test_a_table_that_does_not_fit_is_named(change, message):
    assert change[0] in TEXT
    with pytest.raises(InputError) as error:
        parse_regions(TEXT.replace(*change, 1), "t.toml")
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("factors", "message"),
    [
        ({"forhead": 1.0}, "did you mean 'forehead'"),
        ({"chin": 2.5}, "wrinkles 'chin' = 2.5 is out of range"),
        ({"chin": float("nan")}, "out of range; expected 0 to 2"),
    ],
)
def test_factors_that_make_no_sense_are_named(factors, message):
    with pytest.raises(InputError, match=message):
        check_factors(factors)


def test_factors_default_to_one():
    factors = dict(zip(region_names(), check_factors({"glabella": 0.25}), strict=True))
    assert factors.pop("glabella") == 0.25
    assert set(factors.values()) == {1.0}


def test_every_region_has_a_source_and_those_asked_for_are_there():
    assert region_names() == (
        "forehead",
        "glabella",
        "nose_root",
        "bunny",
        "crows_feet",
        "under_eye",
        "nasolabial",
        "wing",
        "sneer",
        "marionette",
        "chin",
    )
    assert all(len(region.sizes.source) > 20 for region in regions())


def test_regions_lie_on_the_face_alike_on_both_sides(head, fine_mirror):
    covered = np.zeros(len(fine_mirror))
    for placed in place_regions(head):
        mask = placed.zone.mask
        assert 50 < np.count_nonzero(mask) < 1500, placed.region.name
        assert mask.max() > 0.4
        assert mask.max() <= 1.0
        np.testing.assert_allclose(mask, mask[fine_mirror], atol=1e-6)
        inside = mask > 0.0
        np.testing.assert_allclose(placed.phase[inside], placed.phase[fine_mirror][inside], atol=1e-6)
        covered += mask
    for name in ("lips", "inner_mouth", "ears", "garment"):
        assert covered[head.skin.matrix @ head.masks[name] > 0.999].max() == 0.0


def test_creases_are_as_far_apart_as_the_table_says(head, rest):
    """Along the forehead's middle the phase rises by one crease per `spacing` mm."""
    placed = place_regions(head)[0]
    middle = (np.abs(rest[:, 0]) < 0.1) & (placed.zone.mask > 0.1)
    order = np.argsort(rest[middle, 1])
    phase, points = placed.phase[middle][order], rest[middle][order]
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert (phase[-1] - phase[0]) * placed.region.layout.spacing == pytest.approx(length, rel=0.2)


def test_the_folds_of_a_frown_part_upwards(head, rest):
    """Parallel grooves of one length look like the prongs of a fork."""
    placed = place_regions(head)[region_names().index("glabella")]
    crease = (np.abs(placed.phase) < 0.12) & (placed.zone.mask > 0.3) & (rest[:, 0] > 0.0)
    x, y = rest[crease, 0], rest[crease, 1]
    assert np.polyfit(y, x, 1)[0] > 0.12
