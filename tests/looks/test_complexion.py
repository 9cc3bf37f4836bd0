import numpy as np
import pytest

from risorius.face.identity import Looks
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
