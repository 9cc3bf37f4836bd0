import numpy as np
import pytest

from risorius.face.head.identity import Looks
from risorius.looks.attributes import ALBEDO, CURVATURE, INNER, MAX_CURVATURE, ROUGHNESS
from risorius.looks.complexion import paint_skin
from risorius.looks.garment import neckline


@pytest.fixture(scope="module")
def painted(anatomy):
    return paint_skin(anatomy, Looks(), neckline(anatomy), np.linspace(0, 1, len(anatomy.skin)))


def test_albedo_is_physical_and_skin_is_warm(painted):
    albedo = painted[:, ALBEDO : ALBEDO + 3]
    assert albedo.min() > 0
    assert albedo.max() < 0.95
    assert (albedo[:, 0] > albedo[:, 2]).all()


def test_lips_are_redder_and_glossier_than_the_forehead(painted, anatomy):
    lips = anatomy.masks["lips"] > 0.9
    forehead = (anatomy.skin[:, 1] > anatomy.eye_height + 40) & (anatomy.skin[:, 2] > 0)
    redness = painted[:, ALBEDO] / painted[:, ALBEDO + 1]
    assert redness[lips].mean() > 1.3 * redness[forehead].mean()
    assert painted[lips, ROUGHNESS].mean() < painted[forehead, ROUGHNESS].mean()


def test_curvature_is_clipped_and_the_mouth_is_marked(painted, anatomy):
    assert painted[:, CURVATURE].max() == pytest.approx(MAX_CURVATURE)
    assert np.array_equal(painted[:, INNER], anatomy.masks["inner_mouth"].astype(np.float32))


def test_a_shaved_beard_darkens_jaw_and_upper_lip_alone(painted, anatomy):
    neck = neckline(anatomy)
    bearded = paint_skin(anatomy, Looks(beard=1.0), neck, np.linspace(0, 1, len(anatomy.skin)))
    share = bearded[:, ALBEDO + 1] / painted[:, ALBEDO + 1]
    x, y, z = anatomy.skin.T
    chin = (np.abs(x) < 12) & (np.abs(y - anatomy.chin - 12) < 6) & (z > 0)
    assert share[chin].max() < 0.9
    assert share[(y > anatomy.nose_tip[1]) & (np.abs(x) < 30)].min() > 0.97
    assert share[anatomy.masks["lips"] > 0.9].min() == pytest.approx(1.0, abs=1e-4)
