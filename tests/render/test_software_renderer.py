from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import binary_erosion

from risorius.errors import InputError
from risorius.looks.anatomy import find_anatomy
from risorius.looks.attributes import EYE_LEFT, EYE_RIGHT, HAIR, SKIN, TEETH, TONGUE
from risorius.render.camera import portrait
from risorius.render.framing import frame_head
from risorius.render.lights import Lamp, LightRig
from risorius.render.software_renderer import SoftwareRenderer

SYMMETRIC = LightRig((Lamp(0, 30, (2, 2, 2)),), (0.5, 0.5, 0.5), (0.3, 0.3, 0.3))


def surfaces(renderer):
    """The surface (rows, columns) that each sample of the last picture shows, −1 for the background."""
    ids = renderer.triangles_shown
    return np.where(ids < 0, -1, renderer.scene.surfaces[ids])


def interior(renderer):
    """Which pixels of the last picture show the mouth's lining or tongue."""
    ids, found = renderer.triangles_shown, surfaces(renderer)
    inner = renderer.scene.attributes[renderer.scene.triangles[ids, 0], 7] > 0.9
    samples = (found == TONGUE) | ((found == SKIN) & inner)
    return samples[::2, ::2] & samples[1::2, 1::2]


@pytest.mark.parametrize(
    ("size", "message"),
    [
        ((8, 100), "picture size 8x100; expected 16 to 4096"),
        ((100, 5000), "picture size 100x5000; expected 16 to 4096"),
        ((100.5, 100), "whole pixels"),
        ((100, 100, 3), "width and height"),
    ],
)
def test_a_size_that_cannot_be_drawn_is_an_error(model, size, message):
    with pytest.raises(InputError, match=message):
        SoftwareRenderer(model, size)


def test_an_unknown_quality_is_an_error_with_the_nearest_one(model):
    with pytest.raises(InputError, match="unknown quality 'norml'; did you mean 'normal'"):
        SoftwareRenderer(model, (64, 64), "norml")


def test_an_unknown_style_is_an_error_with_the_nearest_one(model):
    with pytest.raises(InputError, match="unknown style 'cley'; did you mean 'clay'"):
        SoftwareRenderer(model, (64, 64), style="cley")


def test_a_background_of_another_size_is_an_error(model):
    with pytest.raises(InputError, match="background"):
        SoftwareRenderer(model, (64, 64), background=np.zeros((32, 64, 3), np.float32))


def test_a_buffer_that_does_not_fit_is_an_error(renderer, face):
    for buffer in (np.zeros((240, 241, 3), np.uint8), np.zeros((240, 240, 3), np.float32)):
        with pytest.raises(InputError, match="picture buffer"):
            renderer.render(face(), buffer)


def test_a_frame_of_another_head_is_an_error(renderer, face):
    frame = face()
    with pytest.raises(InputError, match="a frame whose skin is"):
        renderer.render(replace(frame, skin=frame.skin[:-1]))


def test_the_picture_is_bytes_of_the_size_asked_for(model, face):
    picture = SoftwareRenderer(model, (96, 64)).render(face())
    assert picture.shape == (64, 96, 3)
    assert picture.dtype == np.uint8


def test_a_frame_gives_the_same_bytes_whatever_was_drawn_before(renderer, face):
    first = renderer.render(face())
    renderer.render(face(masseter=0.8, head_yaw=20.0))
    assert np.array_equal(renderer.render(face()), first)
    out = np.empty_like(first)
    assert renderer.render(face(), out) is out
    assert np.array_equal(out, first)


def test_every_material_is_drawn(renderer, face):
    renderer.render(face(AU12=0.7, masseter=0.25, tongue_up=0.5))
    found = surfaces(renderer)
    for surface in (-1, SKIN, EYE_LEFT, EYE_RIGHT, TEETH, TONGUE):
        assert (found == surface).sum() > 20
    assert (found >= HAIR).sum() > 5000
    depth = renderer.scene.attributes[renderer.scene.triangles[renderer.triangles_shown, 0], 8]
    assert ((found == SKIN) & (depth > 5)).sum() > 5000


def test_the_head_stands_within_the_frame(renderer, face):
    renderer.render(face())
    found = surfaces(renderer)
    assert (found[:8] == -1).all()
    columns = np.nonzero((found[: len(found) // 2] != -1).any(axis=0))[0]
    assert columns.min() > 0.15 * found.shape[1]
    assert columns.max() < 0.85 * found.shape[1]


def test_pupils_are_dark_and_whites_bright_at_rest(model, face):
    picture = (
        SoftwareRenderer(model, (160, 160), camera=portrait(16, -16, (29, 0, 0))).render(face()).mean(axis=2)
    )
    pupil = picture[70:90, 70:90]
    assert pupil.min() < 40
    assert np.percentile(picture[75:95, 30:130], 95) > 150


def test_lids_hide_the_eyes_when_shut(renderer, face):
    renderer.render(face())
    opened = (surfaces(renderer) == EYE_LEFT).sum()
    renderer.render(face(orbicularis_oculi_palpebralis=1.0))
    assert opened > 100
    assert (surfaces(renderer) == EYE_LEFT).sum() < 0.05 * opened


def test_the_mouth_is_dark_red_inside_and_its_teeth_are_bright(renderer, face):
    colours = renderer.render(face(masseter=0.7))
    picture, red = colours.mean(axis=2), colours[interior(renderer)].mean(axis=0)
    inside = picture[interior(renderer)]
    teeth = picture[(surfaces(renderer) == TEETH)[::2, ::2]]
    assert len(inside) > 40
    assert inside.mean() < 75
    assert 30 < np.percentile(inside, 10) < 45  # not black: cheeks and lips spread the light that enters
    assert red[0] > 1.8 * max(red[1], red[2])
    assert np.percentile(teeth, 80) > 120


def test_no_teeth_show_between_shut_lips(renderer, face):
    renderer.render(face(lip_seal=1.0))
    assert (surfaces(renderer) == TEETH).sum() < 12


def test_gaze_moves_the_iris(model, face):
    renderer = SoftwareRenderer(model, (160, 160), camera=portrait(16, -16, (29, 0, 0)))
    places = []
    for yaw in (-20.0, 20.0):
        dark = renderer.render(face(gaze_yaw=yaw)).mean(axis=2) < 45
        eye = (surfaces(renderer) == EYE_LEFT)[::2, ::2]
        places.append(np.nonzero(dark & eye)[1].mean())
    assert places[1] - places[0] > 20


def test_a_mirrored_face_gives_a_mirrored_picture(model, face):
    renderer = SoftwareRenderer(model, (160, 160), camera=portrait(-30, -110, (0, 0, 0)), lights=SYMMETRIC)
    left = renderer.render(face(**{"zygomatic_major.left": 0.9})).astype(int)
    right = renderer.render(face(**{"zygomatic_major.right": 0.9})).astype(int)
    mirrored = np.abs(left - right[:, ::-1]).mean()
    assert mirrored < 3
    assert mirrored < 0.5 * np.abs(left - right).mean()


def test_light_from_the_other_side_brightens_the_other_cheek(model, face):
    camera = portrait(45, -115, (0, 0, 0))
    for azimuth in (-50.0, 50.0):
        rig = LightRig((Lamp(azimuth, 20, (2, 2, 2)),), (0.2, 0.2, 0.2), (0.2, 0.2, 0.2))
        picture = SoftwareRenderer(model, (96, 96), camera=camera, lights=rig).render(face()).astype(float)
        cheeks = picture[50:65, 22:32].mean(), picture[50:65, 64:74].mean()
        assert (cheeks[0] > cheeks[1]) == (azimuth < 0)


def test_more_samples_smooth_the_outline(model, face):
    frame = face()
    pictures = {
        q: SoftwareRenderer(model, (120, 120), q).render(frame).astype(int)
        for q in ("draft", "normal", "high")
    }
    error = {q: np.abs(pictures[q] - pictures["high"]).mean() for q in ("draft", "normal")}
    assert 0 < error["normal"] < 0.7 * error["draft"]


def test_the_background_shows_where_nothing_stands(model, face):
    background = np.zeros((64, 64, 3), np.float32)
    background[..., 1] = 1.0
    picture = SoftwareRenderer(model, (64, 64), background=background).render(face())
    assert picture[0, 0].tolist() == [0, 255, 0]


def test_a_row_has_room_for_a_patch_in_every_sample(head, model, face):
    """Among lashes seen close by, each sample may show a hair of its own."""
    camera = frame_head(find_anatomy(head), 1.0, "eyes", 120.0)
    renderer = SoftwareRenderer(model, (120, 120), camera=camera)
    renderer.render(face())
    shown = np.where(renderer.triangles_shown >= 0, renderer.scene.surfaces[renderer.triangles_shown], -1)
    pixels = shown.reshape(120, 2, 120, 2).transpose(0, 2, 1, 3).reshape(120, 120, 4)
    patches = max(sum(len(set(pixel[pixel >= 0])) for pixel in row) for row in pixels)
    assert 2 * 120 < patches <= len(renderer._batch.column)


def test_a_draft_shows_what_other_pictures_show(model, face):
    """Light at vertices is that between them: no vertex of a visible triangle is left without."""
    frame = face(masseter=0.4, AU12=0.8, head_yaw=20.0)
    draft, normal = (SoftwareRenderer(model, (240, 240), q) for q in ("draft", "normal"))
    error = np.abs(draft.render(frame).astype(int) - normal.render(frame))
    # Edges, which drafts do not smooth, say nothing about light.
    within = binary_erosion(surfaces(draft) == SKIN, iterations=2)
    # Of hair, other strands lie uppermost in a draft.
    assert error.mean() < 3.5
    assert np.percentile(error[within], 99) < 24


def test_a_draft_is_the_same_whatever_was_drawn_before(model, face):
    fresh, used = (SoftwareRenderer(model, (160, 160), "draft") for _ in range(2))
    used.render(face(masseter=0.9, head_yaw=-30.0))
    frame = face(head_yaw=15.0)
    assert np.array_equal(used.render(frame), fresh.render(frame))


def test_drafts_have_fewer_hairs_and_no_folds(model, face):
    frame = face()
    draft = SoftwareRenderer(model, (160, 160), "draft")
    assert draft.scene.hairs < 0.5 * SoftwareRenderer(model, (160, 160)).scene.hairs
    folded = replace(frame, wrinkles=np.full_like(frame.wrinkles, 2.0))
    assert np.array_equal(draft.render(frame).copy(), draft.render(folded))
