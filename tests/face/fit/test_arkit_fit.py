import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.arkit import EXCLUSIVE, INDEX, OPPOSED, SHAPES
from risorius.core.parameters import INDEX as PARAMETER
from risorius.core.parameters import NEUTRAL
from risorius.errors import HeadError
from risorius.face.fit.arkit_direct import gaze_of
from risorius.face.fit.arkit_fit import BLOCK, ArkitFit
from risorius.face.fit.shapes import arkit_shapes
from risorius.face.head.head import load_head, shipped_heads
from risorius.face.numerics import robust_fit
from risorius.face.solve import FaceSolver
from tests.profiles import everyday, examples

FITTED = [name for name in SHAPES if not name.startswith("eyeLook") and name != "tongueOut"]


@pytest.fixture(scope="module")
def fit(head):
    return ArkitFit.of(head)


def test_a_head_without_shapes_is_named(head, tmp_path: Path) -> None:
    with pytest.raises(HeadError, match=r"head 'standard' has no ARKit shapes; expected shapes.npz"):
        arkit_shapes(replace(head, folder=tmp_path))


def test_a_file_without_a_shape_is_named(head, tmp_path: Path) -> None:
    with np.load(head.folder / "shapes.npz") as archive:
        arrays = {name: archive[name] for name in archive.files if "/jawOpen/" not in name}
    np.savez(tmp_path / "shapes.npz", **arrays)
    with pytest.raises(HeadError, match="'shape/jawOpen/vertices' is missing"):
        arkit_shapes(replace(head, folder=tmp_path))


@pytest.mark.parametrize("name", everyday(shipped_heads(), ["amara", "standard"]))
def test_every_head_has_the_shapes_and_its_jaw_opens(name: str) -> None:
    shapes = arkit_shapes(load_head(name))
    jaw = shapes.skin_at(INDEX["jawOpen"])
    assert shapes.skin.shape[0] == 52
    assert jaw[:, 1].min() < -20.0
    assert shapes.teeth_lower[INDEX["jawOpen"], :, 1].mean() < -8.0
    assert shapes.tongue[INDEX["tongueOut"], :, 2].max() > 10.0
    assert np.abs(shapes.skin_at(INDEX["mouthSmileLeft"])[:, 0]).max() > 3.0


@examples(30)
@given(st.dictionaries(st.sampled_from(FITTED), st.floats(0.0, 1.0), max_size=6))
def test_weights_to_face_to_weights(fit, chosen: dict[str, float]) -> None:
    weights = np.zeros(52)
    for name, value in chosen.items():
        weights[INDEX[name]] = value
    for one, other in OPPOSED:
        if weights[INDEX[one]]:
            weights[INDEX[other]] = 0.0
    weights[INDEX["mouthClose"]] = min(weights[INDEX["mouthClose"]], weights[INDEX["jawOpen"]])
    assert np.abs(fit.of_skin(fit.skin(weights)) - weights).max() < 0.02


def test_rest_is_nothing(fit, face) -> None:
    weights = fit.weights(face())
    assert weights[[INDEX[name] for name in FITTED]].max() < 1e-3


@pytest.mark.parametrize(
    ("targets", "shape"),
    [
        ({"orbicularis_oculi_palpebralis.left": 1.0}, "eyeBlinkLeft"),
        ({"zygomatic_major.right": 0.8}, "mouthSmileRight"),
        ({"masseter": 0.5}, "jawOpen"),
        ({"frontalis_medialis": 1.0}, "browInnerUp"),
        ({"depressor_labii": 1.0}, "mouthLowerDownLeft"),
    ],
)
def test_a_muscle_is_its_shape(fit, face, targets: dict[str, float], shape: str) -> None:
    weights = fit.weights(face(**targets))
    assert weights[INDEX[shape]] > 0.35
    assert SHAPES[int(weights.argmax())].removesuffix("Left").removesuffix("Right") == shape.removesuffix(
        "Left"
    ).removesuffix("Right")


@pytest.mark.parametrize("name", everyday(["standard", "kenji"], ["standard"]))
def test_a_lid_that_is_shut_is_a_whole_blink(name: str) -> None:
    """So that another character's eyes shut, too; and a whole blink shuts ours."""
    fit, solver = ArkitFit.of(load_head(name)), FaceSolver(load_head(name))
    values = NEUTRAL.copy()
    for shut in (0.5, 1.0):
        values[PARAMETER["orbicularis_oculi_palpebralis.left"]] = shut
        weights = fit.weights(solver.solve(values))
        assert weights[INDEX["eyeBlinkLeft"]] == pytest.approx(shut, abs=0.02)
        others = [name for name in FITTED if name != "eyeBlinkLeft"]
        assert weights[[INDEX[name] for name in others]].max() < 0.05


def test_what_the_brows_cannot_reach_moves_little_elsewhere(fit, face) -> None:
    weights = fit.weights(face(**{f"{name}_{'supercilii'}": 1.0 for name in ("corrugator", "depressor")}))
    assert weights[INDEX["browDownLeft"]] > 0.7
    mouth = [INDEX[name] for name in FITTED if name.startswith(("mouth", "jaw"))]
    assert weights[mouth].max() < 0.25


def test_the_eyes_shapes_are_their_angles(fit, face) -> None:
    weights = fit.weights(face(gaze_yaw=20.0, gaze_pitch=-10.0, gaze_distance=100.0))
    assert weights[INDEX["eyeLookOutLeft"]] == pytest.approx(20.0 / 45.0, abs=1e-3)
    assert weights[INDEX["eyeLookInRight"]] == pytest.approx(20.0 / 45.0, abs=1e-3)
    assert weights[INDEX["eyeLookDownLeft"]] == pytest.approx(10.0 / 35.0, abs=1e-3)
    pitch, yaw = gaze_of(weights[None])
    assert (pitch[0], yaw[0]) == pytest.approx((-10.0, 20.0), abs=0.05)


def test_a_sentence_fits(clip) -> None:
    track = clip.arkit
    rms, worst = track.residual
    assert rms < 0.5
    assert worst < 2.2
    weights = track.weights
    assert weights.min() >= 0.0
    assert weights.max() <= 1.0
    assert (weights[:, INDEX["mouthClose"]] <= weights[:, INDEX["jawOpen"]]).all()
    for one, other in EXCLUSIVE:
        assert not (weights[:, INDEX[one]] * weights[:, INDEX[other]]).any(), (one, other)


@pytest.fixture(scope="module")
def bounds_of():
    sys.path.insert(0, str(Path(__file__).parents[3] / "benchmarks"))
    from arkit_bound import bounds_of

    return bounds_of


def test_a_lip_under_the_teeth_is_nearly_as_near_as_52_shapes_can_be(fit, face, bounds_of) -> None:
    """/v/ draws the lower lip back under the teeth, as `mouthRollLower` does but for 0.8 mm.

    The face is even, and so nearly are its weights: nothing of what a lopsided mouth would gain.
    """
    frame = face(lip_tuck=1.0, masseter=0.15, zygomatic_major=0.7)
    weights = fit.weights(frame)
    rms, worst = fit.residual(frame, weights)
    free, one_sided, even = bounds_of(fit, frame.skin, weights)
    assert 0.5 < free <= one_sided <= worst < min(even + 0.4, 1.4)
    assert rms < 0.4


def test_the_bound_of_what_shapes_make_is_nothing(fit, bounds_of) -> None:
    weights = np.zeros(52)
    weights[[INDEX["jawOpen"], INDEX["mouthSmileLeft"]]] = 0.4, 0.6
    assert max(bounds_of(fit, fit.skin(weights), weights)) < 0.02


def test_far_vertices_come_nearer_for_little(fit, face, monkeypatch: pytest.MonkeyPatch) -> None:
    frame = face(orbicularis_oris_funneler=0.6, masseter=0.4, zygomatic_major=0.8)
    near = fit.residual(frame, fit.weights(frame))
    monkeypatch.setattr(robust_fit, "STEPS", 0)
    before = fit.residual(frame, fit.weights(frame))
    assert near[1] < before[1] - 0.1
    assert near[0] < before[0] + 0.15


def test_weights_move_no_faster_than_the_face(fit, head, clip) -> None:
    """Two frames that differ by little have weights that differ by little: the fit does not flicker."""
    before, *_, after = clip.faces([3, 4])
    near = before.skin + 0.01 * (after.skin - before.skin)
    step = np.abs(fit.of_skin(near) - fit.of_skin(before.skin)).max()
    assert step <= 0.05 * max(np.abs(fit.of_skin(after.skin) - fit.of_skin(before.skin)).max(), 0.02)


def test_a_frame_has_the_same_weights_after_others_and_alone(fit, clip) -> None:
    frames = list(clip.faces(range(0, len(clip.times), 4)))
    alone = np.array([fit.weights(frame) for frame in frames])
    assert fit.track(frames).weights == pytest.approx(alone, abs=1e-6)


def test_frames_are_fitted_in_order_across_blocks(fit, face) -> None:
    smile, neutral = face(zygomatic_major=0.6), face()
    track = fit.track(smile if k == BLOCK else neutral for k in range(BLOCK + 2))
    shown = track.weights[:, INDEX["mouthSmileLeft"]]
    assert len(track.weights) == len(track.rms) == BLOCK + 2
    assert np.flatnonzero(shown > 0.2).tolist() == [BLOCK]


@pytest.mark.parametrize("shape", ["tongueOut", "jawLeft"])
def test_a_rig_with_one_shape_gets_that_alone(head, face, shape: str) -> None:
    """Nothing is left to fit: the tongue is not fitted, and the jaw's side has no other one to exclude."""
    weights = ArkitFit(head, [shape]).weights(face(masseter=0.6, tongue_out=0.5, lip_seal=0.0))
    others = np.arange(len(SHAPES)) != INDEX[shape]
    assert not weights[others].any()
    assert (weights[INDEX[shape]] == 0.5) == (shape == "tongueOut")
