import numpy as np

from risorius.looks.garment import cloth_offset, neckline


def test_the_neck_is_bare_and_the_shoulders_are_covered(anatomy):
    depth = neckline(anatomy)
    throat = (anatomy.skin[:, 1] > anatomy.chin - 20) & (anatomy.skin[:, 2] > -90)
    assert (depth[throat] < 0).all()
    assert (depth[np.abs(anatomy.skin[:, 0]) > 120] > 0).all()


def test_cloth_stands_off_the_skin_and_bare_skin_stays(anatomy, surface):
    depth = neckline(anatomy)
    offset = np.linalg.norm(cloth_offset(depth, surface.normals), axis=1)
    assert offset[depth < -2].max() == 0
    assert offset[depth > 4].min() > 1
