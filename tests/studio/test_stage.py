"""Faces on the wire: what is unpacked is what was solved, to half a step, in the order of the head's file."""

from __future__ import annotations

import json
import struct

import numpy as np
import pytest

from risorius.core.action_units import resolve_targets
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.face.head.head import load_head, shipped_heads
from risorius.face.solve import FaceSolver
from risorius.looks.anatomy import find_anatomy
from risorius.looks.garment import neckline
from risorius.looks.head_model import head_model
from risorius.looks.root_attachment import RootedHairs
from risorius.ports.page.face_packer import FRAMES, PARTS, POSE, STEP
from risorius.ports.page.head_glb import head_glb
from risorius.ports.page.head_shade import HEM_STEPS, light, shade
from risorius.ports.page.head_wrinkles import SLOTS, HeadWrinkles
from risorius.studio.faces.solvers import stage_of


@pytest.fixture(scope="module")
def stage():
    return stage_of("standard")


@pytest.fixture(scope="module")
def faces(stage):
    solver, found = FaceSolver(stage.head), []
    for targets in ({"AU12": 1.0, "head_yaw": 20.0}, {"AU27": 1.0, "gaze_pitch": 10.0, "tongue_out": 0.5}):
        values = np.array(NEUTRAL)
        for name, value in resolve_targets(targets).items():
            values[INDEX[name]] = value
        found.append(solver.solve(values))
    return found


def unpacked(stage, message):
    """Return header, poses (n, 14) and positions (n, vertices, 3) in mm, as a page reads them."""
    header = struct.unpack("<6I", message[:24])
    count, vertices, pose = header[3:]
    poses = np.frombuffer(message, "<f4", count * pose, 24).reshape(count, pose)
    steps = np.frombuffer(message, "<i2", 3 * count * vertices, 24 + poses.nbytes)
    steps = steps.reshape(count, vertices, 3)
    told = stage.described()
    return header, poses, np.array(told.origin) + told.step * steps.astype(np.float64)


def test_what_is_unpacked_is_what_was_solved(stage, faces):
    header, poses, positions = unpacked(stage, stage.packed(FRAMES, 7, 30, faces))
    assert header == (FRAMES, 7, 30, 2, stage.vertices, POSE)
    parts = {part.name: part for part in stage.described().parts}
    assert tuple(parts) == PARTS
    for face, pose, points in zip(faces, poses, positions, strict=True):
        for name in ("skin", "tongue", "teeth_lower"):
            part = parts[name]
            there = points[part.first : part.first + part.count]
            assert np.abs(there - getattr(face, name)).max() <= 0.51 * STEP
        assert pose[12] == pytest.approx(face.jaw_angle)
        for place, turn in enumerate((face.head_rotation, *face.eye_rotation)):
            assert np.allclose(_matrix(pose[4 * place : 4 * place + 4]), turn, atol=1e-6)


def _matrix(q):
    x, y, z, w = q.astype(np.float64)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def test_the_heights_of_fine_wrinkles_are_those_that_were_solved(stage, faces):
    message, folds = stage.packed(FRAMES, 1, 0, faces), stage.described().folds
    heights = np.frombuffer(message[-2 * folds.count :], np.uint8).reshape(2, -1) * folds.step
    places = stage.folds.places()
    targets = np.frombuffer(places, "<u4", folds.count)
    vertices, slots = targets // SLOTS, targets % SLOTS
    regions = np.frombuffer(places, np.uint8, SLOTS * len(faces[0].skin), 4 * folds.count).reshape(-1, SLOTS)
    own = regions[vertices, slots].astype(int) - 1
    assert heights.max() > 0.5
    for face, found in zip(faces, heights, strict=True):
        assert np.abs(found - face.wrinkles[vertices, own]).max() <= 0.51 * folds.step
        assert face.wrinkles.sum() == pytest.approx(face.wrinkles[vertices, own].sum(), rel=1e-3)


@pytest.mark.parametrize("name", shipped_heads())
def test_wrinkles_of_all_heads_have_a_slot_each(name):
    """But at a few vertices at the borders of two of them, where these fade."""
    assert HeadWrinkles(load_head(name)).left_out <= 4


def test_brows_and_lashes_turn_with_the_skin_as_the_library_says(stage, faces):
    _, _, positions = unpacked(stage, stage.packed(FRAMES, 1, 0, faces[:1]))
    parts = {part.name: part for part in stage.described().parts}
    for name, points in RootedHairs(head_model(stage.head)).points(faces[0].skin).items():
        part = parts[name]
        assert np.abs(positions[0][part.first : part.first + part.count] - points).max() <= 0.51 * STEP


def test_the_head_s_file_has_the_vertices_of_the_frames(stage):
    data = head_glb(stage)
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20 : 20 + length])
    counts = {
        mesh["name"]: document["accessors"][mesh["primitives"][0]["attributes"]["POSITION"]]["count"]
        for mesh in document["meshes"]
    }
    for part in stage.described().parts:
        assert counts[part.name] == part.count
    nodes = {node["name"]: node for node in document["nodes"]}
    assert {"head", "eye_left", "eye_right", "hair", "teeth_upper"} <= nodes.keys()


def test_all_heads_at_all_ages_fit_the_whole_numbers(stage):
    for age in (0.0, 100.0):
        other = stage_of("standard", age)
        points = np.concatenate([other.head_parts[name].points for name in PARTS])
        # With room for the jaw, which goes down by less than 40 mm.
        assert np.abs(points - other.origin).max() + 40.0 < 32767 * STEP


def test_a_page_is_told_where_lips_meet_and_where_cloth_begins(stage):
    skin = stage.head_parts["skin"].points
    upper, lower = np.array(stage.described().lips).T
    assert np.abs(skin[upper, 0] - skin[lower, 0]).max() < 3.0
    assert np.median(skin[upper, 1] - skin[lower, 1]) >= 0.0
    seen = np.frombuffer(shade(stage.head), np.uint8).reshape(len(skin), -1)
    assert seen.shape[1] == 1 + len(light().lamps) + 1 + 3 + 4
    inside = (seen[:, -8].astype(float) - 128.0) / HEM_STEPS
    depth = neckline(find_anatomy(stage.head)).clip(-128 / HEM_STEPS, 127 / HEM_STEPS)
    assert np.abs(inside - depth).max() <= 0.51 / HEM_STEPS
