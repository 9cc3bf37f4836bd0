from __future__ import annotations

import tracemalloc
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.parameters import INDEX, NEUTRAL, PARAMETERS
from risorius.core.performance import Performance
from risorius.errors import ParameterError
from risorius.face.motion import animate
from risorius.face.solve import checked_values
from tests.profiles import examples

from .conftest import EMOTIONS, values_of


@pytest.mark.parametrize("shape", [(0,), (45,), (47,), (1, 46), ()])
def test_wrong_number_of_values(solver, shape):
    with pytest.raises(ParameterError, match=r"expected \(46,\)"):
        solver.solve(np.zeros(shape))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, -0.01, 1.01])
def test_a_value_out_of_range_is_named(solver, bad):
    values = np.array(NEUTRAL)
    values[INDEX["zygomatic_major.left"]] = bad
    with pytest.raises(ParameterError, match=r"zygomatic_major\.left = .* expected 0 to 1"):
        solver.solve(values)


@pytest.mark.parametrize(("name", "bad"), [("gaze_distance", 0.0), ("head_yaw", 91.0), ("gaze_pitch", -36.0)])
def test_degrees_and_metres_have_ranges_of_their_own(name, bad):
    values = np.array(NEUTRAL)
    values[INDEX[name]] = bad
    with pytest.raises(ParameterError, match=name):
        checked_values(values)


def test_rounding_beyond_the_range_is_forgiven():
    values = np.array(NEUTRAL)
    values[INDEX["masseter"]] = 1.0 + 1e-9
    assert checked_values(values)[INDEX["masseter"]] == 1.0


def test_rest_is_rest(face, head, rest):
    frame = face()
    np.testing.assert_allclose(frame.skin, rest, atol=2e-5)  # float32
    np.testing.assert_array_equal(frame.teeth_lower, head.teeth_lower.vertices.astype(np.float32))
    np.testing.assert_array_equal(frame.head_rotation, np.eye(3))
    assert frame.jaw_angle == 0.0
    assert frame.skin.dtype == np.float32


@pytest.mark.parametrize("emotion", EMOTIONS)
def test_a_frame_does_not_depend_on_what_was_solved_before(solver, emotion):
    values = values_of({**EMOTIONS[emotion], "masseter": 0.15, "lip_seal": 0.6})
    first = solver.solve(values)
    solver.solve(values_of({"AU27": 1.0, "AU45": 1.0}))
    again = solver.solve(values)
    assert first.skin.tobytes() == again.skin.tobytes()
    assert first.tongue.tobytes() == again.tongue.tobytes()


def mirrored(values):
    result = values.copy()
    for p in PARAMETERS:
        if p.side:
            other = p.name.replace(p.side, {"left": "right", "right": "left"}[p.side])
            result[INDEX[other]] = values[INDEX[p.name]]
    result[[INDEX["head_yaw"], INDEX["head_roll"], INDEX["gaze_yaw"]]] *= -1.0
    return result


@given(
    st.dictionaries(st.sampled_from([p.name for p in PARAMETERS if p.side]), st.floats(0.0, 1.0), max_size=6),
    st.floats(0.0, 0.6),
    st.sampled_from([0.0, 0.0, 1.0]),
    st.floats(-25.0, 25.0),
)
@examples(15, derandomize=True)
def test_mirrored_values_give_the_mirrored_face(solver, fine_mirror, muscles, jaw, seal, yaw):
    values = values_of({**muscles, "masseter": jaw, "lip_seal": seal, "gaze_yaw": yaw})
    one, other = solver.solve(values).skin, solver.solve(mirrored(values)).skin
    difference = np.abs(one - other[fine_mirror] * [-1.0, 1.0, 1.0])
    assert difference.max() < 0.15


def test_the_mirrored_face_is_exact_where_nothing_touches(solver, fine_mirror):
    values = values_of({"AU12.left": 0.7, "AU2.left": 0.5, "AU45.right": 0.6, "masseter": 0.3})
    one, other = solver.solve(values).skin, solver.solve(mirrored(values)).skin
    assert np.abs(one - other[fine_mirror] * [-1.0, 1.0, 1.0]).max() < 0.05


def test_no_face_is_turned_inside_out(head, solver):
    rest = head.skin.matrix @ head.rest
    seen = head.skin.matrix @ head.masks["inner_mouth"] < 0.2
    for centre, radius in zip(head.eye_centre, head.eye_radius, strict=True):
        seen &= np.linalg.norm(rest - centre, axis=1) > radius + 4.0  # the lids' margins do turn over
    quads = head.skin.quads[seen[head.skin.quads].all(axis=1)]

    def area(skin):
        a, b, c, d = (skin[quads[:, k]].astype(np.float64) for k in range(4))
        return np.cross(c - a, d - b)

    for targets in EMOTIONS.values():
        for extra in ({}, {"AU45": 1.0}, {"masseter": 0.2, "lip_seal": 1.0}):
            skin = solver.solve(values_of({**targets, **extra})).skin
            turned = (area(skin) * area(rest)).sum(axis=1) < 0.0
            assert turned.mean() < 0.0005, (targets, extra)


def test_parameters_are_kept_and_cannot_be_changed(face):
    frame = face(AU12=0.5)
    assert frame.parameters[INDEX["zygomatic_major.left"]] == 0.5
    with pytest.raises(ValueError, match="read-only"):
        frame.parameters[0] = 1.0


def test_frames_are_made_one_by_one(solver):
    values = np.stack([NEUTRAL, values_of({"masseter": 0.5})])
    frames = animate(Performance(None, Fraction(30), values), solver)
    first = next(frames)
    second = next(frames)
    assert first.jaw_angle == 0.0
    assert second.jaw_angle == pytest.approx(0.5 * solver.head.jaw_angle)
    assert first.skin is not second.skin
    with pytest.raises(StopIteration):
        next(frames)


def test_frames_solved_into_one_room_make_no_arrays(solver):
    """What is left is Python's own: the frame, its rotations and the checked values."""
    buffers = solver.buffers()
    poses = [values_of({"AU12": a, "AU1": a, "masseter": 0.4 * a, "lip_seal": a, "tongue_up": a, "AU43": a})
             for a in (0.3, 0.6, 0.9)]  # fmt: skip
    for pose in poses:  # what compiles, compiles here
        solver.solve(pose, buffers)
    tracemalloc.start()
    try:
        before, _ = tracemalloc.get_traced_memory()
        for pose in poses:
            solver.solve(pose, buffers)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak - before < 18_000  # every one of the arrays in question is larger


def test_a_frame_in_given_room_is_the_same(solver):
    pose, buffers = values_of({"AU12": 0.7, "masseter": 0.2, "tongue_out": 0.5}), solver.buffers()
    solver.solve(values_of({"AU4": 1.0, "AU9": 1.0}), buffers)
    given, own = solver.solve(pose, buffers), solver.solve(pose)
    assert given.skin is buffers.skin
    assert own.skin is not buffers.skin
    for name in ("skin", "teeth_lower", "tongue", "wrinkles"):
        np.testing.assert_array_equal(getattr(given, name), getattr(own, name))
