"""Hairs of files and pages beside those that the renderer turns to its camera; the lashes of shut eyes."""

import numpy as np

from risorius.looks.head_model import FACIAL_HAIRS
from risorius.looks.normals import Normals
from risorius.looks.root_attachment import RootedHairs
from risorius.render.ribbons import WHOLE, ribbons
from risorius.render.software_renderer import SoftwareRenderer

EYE = np.array([0.0, 0.0, 800.0], np.float32)
SIZE = (480, 480)


def midlines(hairs, points):
    return points.reshape(*hairs.widths.shape, 2, 3).mean(axis=2)


def drawn(model, skin, hairs):
    """The midlines (S, P, 3) of the ribbons that the renderer draws on a skin."""
    count = len(skin)
    positions = np.zeros((count + hairs.vertices, 3), np.float32)
    normals = np.zeros_like(positions)
    positions[:count] = skin
    Normals(model.head.skin.quads, count).update(positions[:count], normals[:count])
    shown = np.tile(np.array([WHOLE], np.int8), (len(hairs.widths), 1))
    shape = (hairs.roots, hairs.weights, hairs.curves, hairs.widths)
    ribbons(positions, normals, *shape, shown, EYE, count, np.float32(-2), np.float32(0))
    return midlines(hairs, positions[count:])


def test_hairs_of_files_and_pages_turn_with_the_skin_as_those_of_pictures(model, face):
    riding = RootedHairs(model)
    for targets in ({}, {"AU43": 1.0}, {"AU1": 1.0, "AU4": 1.0}):
        skin = face(**targets).skin
        points = riding.points(skin)
        for name in FACIAL_HAIRS:
            hairs = model.hairs[name]
            apart = midlines(hairs, points[name]) - drawn(model, skin, hairs)
            assert np.abs(apart).max() < 0.002


def test_lashes_turn_down_with_the_lids(model, face):
    """They stayed as at rest in pages and files, as if they grew out of the brows' bone."""
    riding, hairs = RootedHairs(model), model.hairs["lashes"]

    def lines(**targets):
        return midlines(hairs, riding.points(face(**targets).skin)["lashes"])

    at_rest, shut = lines(), lines(AU43=1.0)
    uppers = at_rest[:, 0, 1] > model.anatomy.eye_height + 2.0
    assert uppers.sum() > 60
    (before, after) = (line[uppers, -1] - line[uppers, 0] for line in (at_rest, shut))
    assert np.allclose(np.linalg.norm(before, axis=1), np.linalg.norm(after, axis=1), atol=0.01)
    assert np.median(after[:, 1] - before[:, 1]) < -0.8


def test_displacements_are_those_from_rest(model, face):
    riding, skin = RootedHairs(model), face(AU43=1.0).skin
    rest = model.parts()
    moves = riding.moves(skin - rest["skin"].points)
    for name, points in riding.points(skin).items():
        assert np.abs(rest[name].points + moves[name] - points).max() < 1e-4


def test_shut_eyes_show_a_line_of_lashes(model, face):
    """In the size of a talking head it was dots: two columns in five had nothing dark in them."""
    renderer = SoftwareRenderer(model, SIZE)
    frame = face(AU43=1.0)
    light = renderer.render(frame).astype(float).mean(axis=2)
    for pairs in model.head.lid_pairs:
        margin = frame.skin[pairs[:, 0]].astype(float)
        matrix = renderer.camera.matrix(*SIZE).astype(float)
        x, y, depth = (np.hstack([margin, np.ones((len(margin), 1))]) @ matrix.T).T
        x, y = x / depth, y / depth
        order = np.argsort(x)
        columns = np.arange(int(x.min()) + 6, int(x.max()) - 6)
        rows = np.round(np.interp(columns, x[order], y[order])).astype(int)
        least = np.array([light[r - 2 : r + 4, c].min() for r, c in zip(rows, columns, strict=True)])
        skin = np.array([light[r - 8, c] for r, c in zip(rows, columns, strict=True)])
        assert np.mean(least < 0.62 * skin) > 0.8
