import numpy as np
import pytest
from scipy.spatial import cKDTree

from risorius.face.head.identity import Looks
from risorius.looks.attributes import OCCLUSION
from risorius.looks.brows import brow_shade, grow_brows
from risorius.looks.greying import greyed, greyed_colour
from risorius.looks.hair_styles import grow_hair
from risorius.looks.lashes import grow_lashes, lash_shade
from risorius.looks.locks import waved
from risorius.looks.parts import hair_attributes
from risorius.looks.scalp import flow, hair_density, hair_shade, inside_hairline, scalp_shade
from risorius.looks.strands import Strands, root_frames
from risorius.looks.surface import unit

BROWN = np.array([0.04, 0.025, 0.015])
SKIN = np.array([0.5, 0.35, 0.25])


def curves_in_head(surface, hairs: Strands):
    """Curves (S, P, 3) in the head frame at rest, from the roots' frames."""
    frames = root_frames(surface.points, surface.normals, hairs.roots, hairs.weights)
    origin = np.einsum("sk,skc->sc", hairs.weights, surface.points[hairs.roots])
    return origin[:, None] + np.einsum("spf,sfc->spc", hairs.curves, frames)


@pytest.fixture(scope="module")
def density(anatomy):
    return hair_density(anatomy, anatomy.skin, anatomy.masks["ears"])


def test_the_face_is_bare_and_the_crown_is_covered(anatomy, density):
    p = anatomy.skin
    face = (p[:, 1] < anatomy.eye_height + 40) & (p[:, 2] > -20) & (np.abs(p[:, 0]) < 55)
    assert density[face].max() == 0
    assert density[p[:, 1] > anatomy.top - 10].min() > 0.9
    assert density[anatomy.masks["ears"] > 0.3].max() == 0


def test_the_hairline_is_soft(density):
    assert ((density > 0.05) & (density < 0.95)).sum() > 200


def test_the_hairline_is_an_arch_over_the_forehead(anatomy):
    """It falls towards the temples without a corner, or the forehead looks square."""
    angle = np.radians(np.arange(0.0, 50.0, 5.0))
    out = 95.0 * np.stack([np.sin(angle), np.zeros(10), np.cos(angle)], axis=1)
    points = out + np.array([0.0, anatomy.eye_height, -72.0 * anatomy.unit])
    fall = np.diff(inside_hairline(anatomy, points, uneven=0.0))
    assert (fall >= 0.0).all()
    assert 4.0 < fall[:7].sum() < 12.0
    assert np.diff(fall).max() < 3.0


def test_waves_begin_below_the_crown_and_leave_straight_hair_alone():
    line = np.stack([np.full(40, 60.0), np.linspace(80.0, -120.0, 40), np.full(40, -70.0)], axis=1)[None]
    assert waved(line, 0.0, 1.0) == pytest.approx(line)
    moved = np.linalg.norm(waved(line, 1.0, 1.0) - line, axis=2)[0]
    assert moved[:12].max() == 0.0
    assert moved[-5:].min() > 4.0


def test_combed_hair_lies_along_the_skin_and_back_from_the_face(anatomy, surface, density):
    ahead = flow(anatomy, surface.points, surface.normals)
    assert np.abs((ahead * surface.normals).sum(axis=1)).max() < 1e-3
    top = (density > 0.5) & (surface.points[:, 1] > anatomy.top - 25)
    assert (ahead[top, 2] < 0).mean() > 0.95


def test_hair_grows_from_the_scalp_and_stays_off_the_skull(anatomy, surface):
    hairs = grow_hair(anatomy, surface, BROWN, Looks(hairs=800))["hair"]
    curves = curves_in_head(surface, hairs)
    assert inside_hairline(anatomy, curves[:, 0]).min() > -10
    _, near = cKDTree(surface.points).query(curves[:, 2:].reshape(-1, 3))
    height = ((curves[:, 2:].reshape(-1, 3) - surface.points[near]) * surface.normals[near]).sum(axis=1)
    assert np.percentile(height, 1) > -1.0
    assert height.max() < 40


def test_brows_are_mirrored_and_lie_over_the_eyes(anatomy, surface):
    brows = grow_brows(anatomy, surface, BROWN, SKIN, count=100)
    curves = curves_in_head(surface, brows)
    left, right = curves[:100], curves[100:]
    assert left * [-1, 1, 1] == pytest.approx(right, abs=0.6)
    assert (left[:, 0, 0] > 0).all()
    assert left[:, 0, 1].min() > anatomy.eye_height + 5
    assert left[:, 0, 1].max() < anatomy.eye_height + 35


def test_brows_fade_at_their_heads_and_edges(anatomy, surface):
    brows = grow_brows(anatomy, surface, BROWN, SKIN, count=400)
    x = np.abs(curves_in_head(surface, brows)[:, 0, 0]) / anatomy.unit
    light = brows.colours.mean(axis=1)
    assert light[x < 14].mean() > 1.4 * light[(x > 24) & (x < 40)].mean()
    assert light.max() < SKIN.mean()


def test_chin_length_hair_covers_the_ears_and_turns_in_at_its_ends(anatomy, surface):
    hairs = grow_hair(anatomy, surface, BROWN, Looks(hair_style="medium", hairs=3000))["hair"]
    curves = curves_in_head(surface, hairs)
    out = np.hypot(curves[..., 0], curves[..., 2] + 72.0 * anatomy.unit)
    hanging = curves[:, -1, 1] < anatomy.mouth[1] - 20.0
    assert hanging.mean() > 0.25
    assert (out[hanging, -1] < out[hanging].max(axis=1) - 2.0).mean() > 0.8
    ears = anatomy.skin[anatomy.masks["ears"] > 0.9]
    points = curves.reshape(-1, 3)
    beside = points[(np.abs(points[:, 1:] - ears[:, 1:].mean(axis=0)) < 12.0).all(axis=1)]
    assert np.percentile(np.abs(beside[:, 0]), 80) > np.percentile(np.abs(ears[:, 0]), 80)


def test_skin_is_darkened_under_the_brows_alone(anatomy):
    shade = brow_shade(anatomy)
    assert shade.max() > 0.5
    assert shade[anatomy.skin[:, 1] < anatomy.eye_height].max() < 0.01
    assert shade[np.abs(anatomy.skin[:, 0]) < 4].max() < 0.05


def test_lashes_point_out_of_the_eye(head, surface):
    lashes = grow_lashes(head, surface, BROWN, SKIN, upper=20, lower=10)
    curves = curves_in_head(surface, lashes)
    side = np.repeat([0, 1], 30)
    out = unit(curves[:, 0] - head.eye_centre[side])
    assert ((unit(curves[:, -1] - curves[:, 0]) * out).sum(axis=1) > 0.25).all()
    distance = np.linalg.norm(curves[:, 0] - head.eye_centre[side], axis=1)
    assert np.abs(distance - head.eye_radius[side]).max() < 4
    lengths = np.linalg.norm(np.diff(curves, axis=1), axis=2).sum(axis=1)[:20]
    assert lengths[-3:].max() < 0.75 * lengths.max()  # at the outer corner they stand out beyond the face


def test_the_same_hairs_grow_every_time(anatomy, surface):
    first, second = (grow_hair(anatomy, surface, BROWN, Looks(hairs=200))["hair"] for _ in range(2))
    assert np.array_equal(first.curves, second.curves)
    assert np.array_equal(first.colours, second.colours)


@pytest.mark.parametrize("style", ["short", "medium", "tied", "shaved"])
def test_every_cut_leaves_the_face_free_and_enters_no_skull(anatomy, surface, style):
    grown = grow_hair(anatomy, surface, BROWN, Looks(hairs=1200, hair_style=style)).values()
    points = np.concatenate([curves_in_head(surface, hairs)[:, 1:].reshape(-1, 3) for hairs in grown])
    x, y, z = np.abs(points[:, 0]), points[:, 1] - anatomy.eye_height, points[:, 2]
    assert not ((x < 45) & (y < 25) & (y > -110) & (z > 0)).any()
    _, near = cKDTree(surface.points).query(points)
    height = ((points - surface.points[near]) * surface.normals[near]).sum(axis=1)
    assert np.percentile(height, 5) > -3.0


def test_medium_hair_hangs_lower_than_short_hair(anatomy, surface):
    lowest = {}
    for style in ("short", "medium"):
        hairs = grow_hair(anatomy, surface, BROWN, Looks(hairs=1200, hair_style=style))["hair"]
        lowest[style] = np.percentile(curves_in_head(surface, hairs)[:, -1, 1], 10)
    assert lowest["medium"] < lowest["short"] - 20
    assert lowest["medium"] == pytest.approx(anatomy.chin, abs=40)


def test_tied_hair_runs_to_a_bun_behind_the_head_and_leaves_the_ears_free(anatomy, surface):
    hairs = grow_hair(anatomy, surface, BROWN, Looks(hair_style="tied", hairs=1200))["hair"]
    curves = curves_in_head(surface, hairs)
    back = anatomy.skin[anatomy.skin[:, 1] > anatomy.eye_height, 2].min()
    assert np.abs(curves[:, -1, 0]).max() < 40.0
    assert curves[:, -1, 2].max() < back + 25.0
    assert curves[..., 2].min() < back - 12.0
    ears = anatomy.skin[anatomy.masks["ears"] > 0.9]
    assert cKDTree(curves.reshape(-1, 3)).query(ears)[0].min() > 1.0


def test_a_bald_head_has_no_hair_and_no_shade_of_it(anatomy, surface):
    assert grow_hair(anatomy, surface, BROWN, Looks(hair_style="bald")) == {}
    assert scalp_shade(anatomy, "bald").max() == 0
    assert all(share.max() == 0 for share in hair_shade(anatomy, "bald", np.array([[0.0, 1.0, 0.0]]), 0.1))


def test_hair_shades_the_forehead_below_the_hairline_from_above(anatomy):
    taken, around = hair_shade(anatomy, "short", np.array([[0.0, 0.7, 0.7], [0.6, 0.6, -0.6]]), 0.02)
    inside = inside_hairline(anatomy, anatomy.skin)
    front = (anatomy.skin[:, 2] > 0) & (anatomy.masks["ears"] < 0.01)
    close, far = front & (inside < -3) & (inside > -8), front & (inside < -25)
    assert (taken[close].mean(axis=0) > 0.05).all()
    assert taken[far].max() == 0
    assert around[far].max() == 0


def test_skin_behind_chin_length_hair_is_in_its_shade_and_the_face_is_not(anatomy):
    taken, around = hair_shade(anatomy, "medium", np.array([[0.0, 0.7, 0.7]]), 0.02)
    ears = anatomy.masks["ears"] > 0.9
    assert taken[ears].mean() > 0.9
    assert around[ears].mean() > 0.7
    height = anatomy.skin[:, 1] - anatomy.eye_height
    face = (np.abs(anatomy.skin[:, 0]) < 45) & (height < 34) & (anatomy.skin[:, 2] > 0)
    assert taken[face].max() == 0


def test_chin_length_hair_darkens_no_skin_before_its_first_hairs(anatomy):
    bare = inside_hairline(anatomy, anatomy.skin, uneven=0.0) < 3.0
    assert scalp_shade(anatomy, "medium")[bare].max() == 0
    assert scalp_shade(anatomy, "medium").max() > 0.8


def test_the_scalp_is_shaded_by_its_distance_from_the_hairline_alone(anatomy):
    distance = inside_hairline(anatomy, anatomy.skin, uneven=0.0)
    free = anatomy.masks["ears"] < 0.04
    for style in ("short", "medium", "tied"):
        shade = scalp_shade(anatomy, style)[free][np.argsort(distance[free])]
        assert (np.diff(shade) >= 0.0).all()


@pytest.mark.parametrize("style", ["short", "medium", "tied"])
def test_hair_begins_with_fine_short_hairs(anatomy, surface, style):
    parts = grow_hair(anatomy, surface, BROWN, Looks(hairs=4000, hair_style=style))
    fine, hair = parts["hairline"], parts["hair"]
    assert fine.widths.max() < 0.5 * hair.widths.max()
    curves = curves_in_head(surface, fine)
    assert np.linalg.norm(np.diff(curves, axis=1), axis=2).sum(axis=1).max() < 40
    first = [
        np.percentile(inside_hairline(anatomy, curves_in_head(surface, h)[:, 0]), 2) for h in (fine, hair)
    ]
    assert first[0] < first[1]
    outermost = inside_hairline(anatomy, curves[:, 0]) < 1.0
    assert fine.colours[outermost].mean() > 2.0 * fine.colours[~outermost].mean()  # else each is a dash
    back = curves[:, -1] - curves[:, 0]
    assert ((back[:, 2] < 0) | (np.abs(back[:, 0]) > np.abs(back[:, 1]))).mean() > 0.95


def test_the_roots_along_a_parting_lie_bare(anatomy, surface):
    hair = grow_hair(anatomy, surface, BROWN, Looks(hairs=4000, hair_style="medium"))["hair"]
    light = hair_attributes(hair).reshape(*hair.widths.shape, 2, -1)[:, 0, 0, OCCLUSION]
    assert light[hair.bare > 0.7].min() > 2 * np.median(light[hair.bare < 0.01])


def test_light_reaches_the_roots_of_light_hair(anatomy, surface):
    roots = [
        hair_attributes(grow_hair(anatomy, surface, colour, Looks(hairs=400))["hair"])[::12, OCCLUSION].mean()
        for colour in (BROWN, np.full(3, 0.6))
    ]
    assert roots[1] > 1.5 * roots[0]


def test_upper_lashes_reach_forwards_more_than_they_rise(head, surface):
    """Seen from the front they are a dark line with fine tips, not a row of spikes over the lid."""
    curves = curves_in_head(surface, grow_lashes(head, surface, BROWN, SKIN, upper=20, lower=10))[:20]
    rise, reach = (curves[:, -1] - curves[:, 0])[:, 1], (curves[:, -1] - curves[:, 0])[:, 2]
    assert rise.mean() < 0.7 * reach.mean()
    assert 0.5 < rise.max() < 3.5


def test_skin_is_darkened_at_the_margins_of_the_upper_lids_alone(head, anatomy):
    shade = lash_shade(head, anatomy.skin)
    for pairs in head.lid_pairs:
        assert shade[pairs[:, 0]].min() > 0.99
    away = np.abs(anatomy.skin[:, 1] - anatomy.eye_height) > 8.0
    assert shade[away].max() < 0.01


def test_lower_lashes_are_fainter_than_upper_ones(head, surface):
    lashes = grow_lashes(head, surface, BROWN, SKIN, upper=20, lower=10)
    faint = np.tile(np.repeat([False, True], [20, 10]), 2)
    brightness = lashes.colours.mean(axis=-1)
    assert brightness[faint].min() > 1.5 * brightness[~faint].max()
    widths = lashes.widths.max(axis=1)
    assert widths[faint].max() < widths[~faint].min()


def test_of_greying_hair_some_is_grey_before_other(head, surface):
    hairs = grow_lashes(head, surface, BROWN, SKIN)
    assert greyed(hairs, 0.0) is hairs
    few, half, all_ = (greyed(hairs, share).colours.mean(axis=1) for share in (0.1, 0.5, 1.0))
    before = hairs.colours.mean(axis=1)
    assert (few == before).mean() > 0.7
    assert (few > 1.5 * before).any()
    assert (before <= half).all()
    assert (half <= all_ + 1e-6).all()
    assert all_.min() > 0.15
    assert np.allclose(greyed_colour(BROWN, 0.0), BROWN)
