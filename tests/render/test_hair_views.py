from dataclasses import replace

import numpy as np
import pytest

from risorius.face.numerics.rotations import head_rotation
from risorius.looks.attributes import HAIR
from risorius.render import hair_views
from risorius.render.software_renderer import SoftwareRenderer


@pytest.fixture(scope="module")
def drawn(model):
    return SoftwareRenderer(model, (160, 160))


def seen(renderer, frame):
    """The hairs that win a sample of a picture."""
    renderer.render(frame)
    ids = renderer.triangles_shown
    found = renderer.scene.surfaces[ids[ids >= 0]]
    return np.unique(found[found >= HAIR])


@pytest.mark.parametrize("angles", [(0, 0, 0), (9, -31, 4), (-20, 70, 0), (5, 178, 0)])
def test_leaving_out_hidden_hairs_hardly_changes_what_is_seen(drawn, face, angles):
    frame = replace(face(), head_rotation=head_rotation(*angles))
    views, drawn.hair_views = drawn.hair_views, None
    try:
        everything, whole = seen(drawn, frame), drawn.triangles_shown.copy()
    finally:
        drawn.hair_views = views
    kept = seen(drawn, frame)
    assert len(np.setdiff1d(everything, kept)) < 0.12 * len(everything)
    assert (drawn.triangles_shown != whole).mean() < 0.007


def test_at_least_half_of_the_hair_is_left_out(drawn, face):
    shown = drawn.hair_views.seen(drawn.camera.eye, face().head_rotation)
    first, last = shown.points.T.astype(int)
    scene, facial = drawn.scene, drawn.scene.facial_hairs
    segments = np.zeros(scene.hairs, int)
    np.maximum.at(segments, scene.surfaces[scene.solid :] - HAIR, scene.hair_segments + 1)
    parts = np.maximum(np.minimum(last, segments) - first, 0)
    assert parts[facial:].sum() < 0.5 * segments[facial:].sum()
    assert len(shown.order) < 0.75 * len(scene.triangles)
    assert (first[:facial] == 0).all()
    assert (last[:facial] >= segments[:facial]).all()


def test_what_is_left_out_does_not_depend_on_the_pictures_before(drawn, model, face):
    frame = replace(face(), head_rotation=head_rotation(3, 25, 0))
    drawn.render(face())
    assert (drawn.render(frame) == SoftwareRenderer(model, (160, 160)).render(frame)).all()


def test_a_close_up_shows_every_hair(model):
    close = SoftwareRenderer(model, (160, 160)).camera
    near = replace(close, field_of_view=1.0)
    assert SoftwareRenderer(model, (720, 720), camera=near).hair_views is None


def test_views_of_before_are_not_drawn_again(drawn, model, face, monkeypatch):
    frame = replace(face(), head_rotation=head_rotation(-8, 50, 2))
    before = drawn.render(frame)
    monkeypatch.setattr(hair_views, "project", lambda *_: pytest.fail("drawn again"))
    assert (SoftwareRenderer(model, (160, 160)).render(frame) == before).all()
