import numpy as np
import pytest

from risorius.core.look import FRAMINGS, LIGHTS, STYLES
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.render.from_look import renderer_from_look
from risorius.render.lights import RIGS
from risorius.settings import Look

SIZE = (120, 120)


def picture(head, frame, **look):
    return renderer_from_look(head, SIZE, Look(**look)).render(frame)


@pytest.mark.parametrize("style", STYLES)
def test_every_style_draws_the_head_before_its_background(head, face, style):
    drawn = picture(head, face(), style=style, background="#0000ff")
    blue = (drawn[..., 2] > 250) & (drawn[..., 0] < 5)
    assert blue[:3].all()
    assert not blue[40:80, 45:75].any()


def test_clay_has_no_colour(head, face):
    drawn = picture(head, face(), style="clay", background="black").astype(int)
    grey = picture(head, face(), background="black").astype(int)
    assert np.abs(drawn[50:90, 45:75, 0] - drawn[50:90, 45:75, 2]).mean() < 28
    assert np.abs(grey[50:90, 45:75, 0] - grey[50:90, 45:75, 2]).mean() > 40


def test_the_mesh_shows_as_lines(head, face):
    rough = {s: picture(head, face(), style=s).astype(float)[30:90, 40:80] for s in ("clay", "wireframe")}
    steps = {style: np.abs(np.diff(part, axis=1)).mean() for style, part in rough.items()}
    assert steps["wireframe"] > 2 * steps["clay"]


def test_a_contracted_muscle_is_painted_red_and_a_suppressed_one_yellow(head, face):
    renderer = renderer_from_look(head, SIZE, Look(style="muscles"))
    rest = renderer.render(face()).astype(int)
    smile = renderer.render(face(zygomatic_major=1.0)).astype(int)
    redder = (smile[..., 0] - smile[..., 1]) - (rest[..., 0] - rest[..., 1])
    assert (redder > 40).sum() > 30
    taken = np.zeros(len(NEUTRAL))
    taken[[INDEX["zygomatic_major.left"], INDEX["zygomatic_major.right"]]] = 1.0
    hot = renderer.render(face(), suppression=taken).astype(int)
    assert ((hot[..., 0] > 200) & (hot[..., 2] < 140)).sum() > 30


@pytest.mark.parametrize("light", LIGHTS)
def test_every_light_shows_a_face_that_is_neither_black_nor_burnt(head, face, light):
    cheeks = picture(head, face(), light=light)[60:75, 45:75]
    assert 25 < cheeks.mean() < 235
    assert (cheeks == 255).mean() < 0.02


def test_pupils_are_wide_in_the_dark():
    assert RIGS["dark"].pupil > 1.3 * RIGS["daylight"].pupil


@pytest.mark.parametrize("camera", FRAMINGS)
def test_every_framing_is_filled_by_the_head(head, face, camera):
    drawn = picture(head, face(), camera=camera, background="transparent")
    assert drawn.shape == (120, 120, 4)
    assert drawn[60, 60, 3] == 255
    assert (drawn[..., 3] > 0).mean() > 0.35


def test_a_transparent_picture_is_the_opaque_one_within_the_head(head, face):
    cut, whole = (picture(head, face(), background=b) for b in ("transparent", "black"))
    solid = cut[..., 3] == 255
    assert np.array_equal(cut[solid][:, :3], whole[solid])
    assert (cut[:4, :, 3] == 0).all()
    assert ((cut[..., 3] > 0) & ~solid).sum() > 100


def test_a_darker_complexion_gives_a_darker_face(head, face):
    light = [picture(head, face(), complexion=c)[60:80, 45:75].mean() for c in (0.0, 0.5, 1.0)]
    assert light[0] > light[1] + 20
    assert light[1] > light[2] + 20
