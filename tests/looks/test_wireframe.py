import numpy as np

from risorius.looks.wireframe import edge_strengths


def test_every_side_of_a_quad_is_drawn_and_no_diagonal(head):
    strengths = edge_strengths(head, len(head.skin.triangles) + 5)
    skin = strengths[: len(head.skin.triangles)]
    assert (strengths[len(skin) :] == 0).all()
    assert ((skin == 0).sum(axis=1) == 1).all()
    assert set(np.unique(skin)) == {np.float32(0.0), np.float32(0.28), np.float32(1.0)}


def test_an_edge_is_as_strong_on_both_of_its_triangles(head):
    strengths, seen = edge_strengths(head, len(head.skin.triangles)), {}
    for corners, row in zip(head.skin.triangles[:4000], strengths, strict=False):
        for k in range(3):
            edge = frozenset((int(corners[(k + 1) % 3]), int(corners[(k + 2) % 3])))
            assert seen.setdefault(edge, row[k]) == row[k]
