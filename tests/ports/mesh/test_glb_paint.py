"""The colours in a GLB, looked up as an engine does."""

from dataclasses import replace

import numpy as np
import pytest

from risorius.core.arrays import Array, ByteArray
from risorius.core.parameters import NEUTRAL
from risorius.face.head.head import Head, load_head
from risorius.face.solve import FaceSolver
from risorius.looks.anatomy import find_anatomy
from risorius.looks.attributes import INNER
from risorius.looks.garment import neckline
from risorius.looks.head_model import head_model
from risorius.looks.parts import Part
from risorius.looks.srgb import linear, srgb_decode
from risorius.ports.mesh.glb_paint import GlbPaint, shown
from risorius.render.software_renderer import SoftwareRenderer

WHITE, BLACK = (250, 250, 250), (12, 12, 12)


def looked_up(picture: ByteArray, places: Array) -> Array:
    """A picture (2, n, 3) at places (k, 2), straight from pixel to pixel, clamped at its edges."""
    rows, columns = picture.shape[:2]
    across = np.clip(places[:, 0] * columns - 0.5, 0.0, columns - 1.0)
    down = np.clip(places[:, 1] * rows - 0.5, 0.0, rows - 1.0)
    k = np.minimum(across.astype(int), columns - 2)
    part = (across - k)[:, None]
    first, second = (row[k] + (row[k + 1].astype(float) - row[k]) * part for row in picture)
    return np.asarray(first + (second - first) * down[:, None])


@pytest.fixture(scope="module", params=["standard", "kwame"])
def head(request: pytest.FixtureRequest) -> Head:
    return load_head(request.param)


def painted(head: Head) -> tuple[GlbPaint, Part, Array]:
    """The skin's paint and part, and its colours as shown (n, 3)."""
    paint, skin = GlbPaint(head), head_model(head).solids["skin"]
    factors = srgb_decode(looked_up(paint.skin_picture(skin), paint.skin_places()) / 255.0)
    return paint, skin, paint.colours(skin) * factors


@pytest.mark.parametrize("cloth", [None, WHITE, BLACK])
def test_bare_skin_keeps_its_colour_and_cloth_has_its_own(
    head: Head, cloth: tuple[int, int, int] | None
) -> None:
    if cloth is not None:
        looks = replace(head.identity.looks, cloth=cloth)
        head = replace(head, identity=replace(head.identity, looks=looks))
    paint, skin, seen = painted(head)
    depth, lit = neckline(find_anatomy(head)), paint.shade(skin) > 0.999
    bare, worn = lit & (depth < -12.0), lit & (depth > 12.0)
    assert bare.sum() > 5000
    assert worn.sum() > 500
    assert np.abs(seen[bare] - shown(skin.attributes[bare, :3])).max() < 1e-3
    assert np.abs(seen[worn] - shown(linear(head.identity.looks.cloth))).max() < 0.01


def test_cheeks_are_no_redder_in_white_light_than_in_our_pictures(head: Head) -> None:
    """Our film makes light skin paler; engines showed its albedo, as if the face blushed."""
    _, skin, seen = painted(head)
    model = head_model(head)
    renderer = SoftwareRenderer(model, (240, 240))
    picture = srgb_decode(renderer.render(FaceSolver(head).solve(np.array(NEUTRAL))) / 255.0)
    x, y, _ = np.abs(skin.points - model.anatomy.nose_tip).T / model.anatomy.unit
    cheeks = (x > 22.0) & (x < 42.0) & (y < 12.0) & (model.skin.normals[:, 2] > 0.6)
    place = np.hstack([skin.points[cheeks], np.ones((cheeks.sum(), 1))])
    across, down, depth = renderer.camera.matrix(240, 240).astype(float) @ place.T
    ours = picture[(down / depth).astype(int), (across / depth).astype(int)]
    redder = np.median(seen[cheeks, 0] / seen[cheeks, 1]) / np.median(ours[:, 0] / ours[:, 1])
    assert 0.8 < redder < 1.1


def test_the_neckline_is_a_line_and_cloth_is_matt(head: Head) -> None:
    paint, skin, _ = painted(head)
    depths = np.linspace(-2.0, 2.0, 400)
    places = np.stack([0.5 + depths / 128.0, np.full(400, 0.5)], axis=1)
    rough = looked_up(paint.surface_picture(), places)[:, 1] / 255.0
    between = (rough > rough.min() + 0.01) & (rough < rough.max() - 0.01)
    assert np.ptp(depths[between]) < 0.3
    assert rough[-1] > 0.85 > 0.6 > rough[0]
    # What stands between two vertices of the skin is found between their places.
    assert np.ptp(paint.skin_places()[np.abs(neckline(find_anatomy(head))) < 40.0, 0]) > 0.5
    assert skin.attributes.shape[0] == len(paint.skin_places())


def test_the_mouth_is_dark_within_and_teeth_are_light_in_front(head: Head) -> None:
    paint, parts = GlbPaint(head), head_model(head).solids
    behind = find_anatomy(head).mouth[2] - parts["skin"].points[:, 2]
    lining = (parts["skin"].attributes[:, INNER] > 0.99) & (behind > 20.0)
    assert paint.shade(parts["skin"])[lining].max() < 0.4
    teeth = parts["teeth_upper"]
    front = teeth.points[:, 2] > np.quantile(teeth.points[:, 2], 0.9)
    shade = paint.shade(teeth)
    assert np.median(shade[front]) > 2.0 * np.median(
        shade[teeth.points[:, 2] < np.median(teeth.points[:, 2])]
    )


def test_lids_shade_the_white_of_the_eye_and_not_the_iris(head: Head) -> None:
    picture = GlbPaint(head).eye_picture().astype(float).sum(axis=2)
    middle = len(picture) // 2
    across = picture[middle]
    assert across[int(middle * 0.15)] < 0.85 * across[int(middle * 0.56)]


def test_what_hair_covers_is_darker_than_the_face() -> None:
    paint, skin, _ = painted(load_head("standard"))
    shade, anatomy = paint.shade(skin), find_anatomy(load_head("standard"))
    ears = anatomy.masks["ears"] > 0.5
    face = (anatomy.skin[:, 2] > anatomy.mouth[2] - 25.0) & (skin.attributes[:, INNER] < 0.01)
    assert np.median(shade[ears]) < 0.7
    assert np.quantile(shade[face & (neckline(anatomy) < 0.0)], 0.2) > 0.95
