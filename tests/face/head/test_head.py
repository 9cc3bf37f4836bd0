from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import risorius.heads
from risorius.core.parameters import MUSCLES
from risorius.errors import HeadError
from risorius.face.head.head import Field, Head, load_head, required_fields

FILE = Path(next(iter(risorius.heads.__path__))) / "standard" / "head.npz"
Arrays = dict[str, np.ndarray]
IBUG_MIRROR = [*range(16, -1, -1), *range(26, 16, -1), 27, 28, 29, 30, 35, 34, 33, 32, 31]
IBUG_MIRROR += [45, 44, 43, 42, 47, 46, 39, 38, 37, 36, 41, 40]
IBUG_MIRROR += [54, 53, 52, 51, 50, 49, 48, 59, 58, 57, 56, 55, 64, 63, 62, 61, 60, 67, 66, 65]


@pytest.fixture(scope="module")
def head() -> Head:
    return load_head("standard")


@pytest.fixture
def spoilt(tmp_path: Path) -> Callable[[Callable[[Arrays], Any]], Path]:
    """Return a function that writes the standard head after a change to its arrays."""

    def write(change: Callable[[Arrays], Any]) -> Path:
        with np.load(FILE) as archive:
            arrays = {name: archive[name] for name in archive.files}
        change(arrays)
        path = tmp_path / "head.npz"
        np.savez(path, **arrays)
        return path

    return write


def posed(head: Head, **activations: float) -> np.ndarray:
    """Level-0 positions with fields added and the jaw turned, nothing else."""
    masseter = activations.pop("masseter", 0.0)
    points = head.rest.copy()
    for name, value in activations.items():
        for field in (head.fields[n] for n in head.fields if n.split(".")[0] == name):
            points[field.vertices] += value * field.displacement
    arm = points - head.jaw_point
    angle = (head.jaw_weight * masseter * head.jaw_angle)[:, None]
    along = (arm @ head.jaw_axis)[:, None] * head.jaw_axis
    turned = (arm - along) * np.cos(angle) + np.cross(head.jaw_axis, arm) * np.sin(angle)
    points = head.jaw_point + along + turned
    points[head.jaw_corrective.vertices] += masseter * head.jaw_corrective.displacement
    return points


def dense(head: Head, field: Field) -> np.ndarray:
    result = np.zeros_like(head.rest)
    result[field.vertices] = field.displacement
    return result


class TestInvalid:
    def test_unknown_name(self) -> None:
        with pytest.raises(HeadError, match="unknown head 'standrad'; did you mean 'standard'"):
            load_head("standrad")

    def test_folder_without_a_head(self, tmp_path: Path) -> None:
        with pytest.raises(HeadError, match=r"head\.npz"):
            load_head(tmp_path)

    def test_not_an_archive(self, tmp_path: Path) -> None:
        (tmp_path / "head.npz").write_bytes(b"not a zip")
        with pytest.raises(HeadError, match=r"head\.npz: not a head file"):
            load_head(tmp_path)

    def test_missing_array(self, spoilt: Callable[..., Path]) -> None:
        with pytest.raises(HeadError, match="'jaw_weight' is missing"):
            load_head(spoilt(lambda a: a.pop("jaw_weight")))

    def test_missing_muscle(self, spoilt: Callable[..., Path]) -> None:
        with pytest.raises(HeadError, match=r"'field/risorius\.left/vertices' is missing"):
            load_head(spoilt(lambda a: a.pop("field/risorius.left/vertices")))

    def test_joint_field_of_an_unknown_muscle(self, spoilt: Callable[..., Path]) -> None:
        def change(arrays: Arrays) -> None:
            for part in ("vertices", "values", "scale"):
                old = f"joint/triangularis.left+risorius.left/{part}"
                arrays[f"joint/triangularis.left+buccinator.left/{part}"] = arrays.pop(old)

        with pytest.raises(HeadError, match=r"is not named by two parameters; expected joint/FIRST\+SECOND"):
            load_head(spoilt(change))

    def test_a_file_without_joint_fields_has_none(self, spoilt: Callable[..., Path]) -> None:
        def change(arrays: Arrays) -> None:
            for name in [name for name in arrays if name.startswith("joint/")]:
                del arrays[name]

        assert load_head(spoilt(change)).joint == {}

    @pytest.mark.parametrize(
        ("name", "value", "message"),
        [
            ("format", np.array(99), "is 99; expected 1"),
            ("rest", np.zeros((7, 2)), r"has shape \(7, 2\); expected \(N, 3\)"),
            ("neck_weight", np.zeros(3), r"has shape \(3,\); expected \(\d+,\)"),
            ("eye_radius", np.zeros(2), "spans 0 to 0; expected 1.0 to None"),
            ("jaw_axis", np.array([2.0, 0.0, 0.0]), "has length 2; expected 1"),
            ("jaw_point", np.array([0.0, np.nan, 0.0]), "not a finite number"),
            ("lip_pairs", np.array([[0, 60000]]), "points outside"),
            ("lip_pairs", np.array([[-1, 2]]), "points outside"),
            ("lip_pairs", np.zeros((0, 2), int), r"has shape \(0, 2\)"),
            ("lid_pairs_left", np.array([[0.0, 1.0]]), "expected whole numbers"),
            ("mask/lips", None, "spans"),
        ],
    )
    def test_wrong_array(self, spoilt: Callable[..., Path], name: str, value: Any, message: str) -> None:
        def change(arrays: Arrays) -> None:
            arrays[name] = arrays[name] * 2.0 if value is None else value

        with pytest.raises(HeadError, match=message) as caught:
            load_head(spoilt(change))
        assert f"array '{name}'" in str(caught.value)


class TestStandard:
    def test_is_small(self) -> None:
        assert FILE.stat().st_size < 2_000_000

    def test_is_loaded_once(self, head: Head) -> None:
        assert load_head("standard") is head
        assert load_head(FILE.parent) is head

    def test_arrays_are_read_only(self, head: Head) -> None:
        arrays = [
            head.rest,
            head.quads,
            head.masks["lips"],
            head.fields["lip_tuck"].displacement,
            head.lip_pairs,
        ]
        assert not any(array.flags.writeable for array in arrays)

    def test_has_a_field_per_muscle_but_the_jaw(self, head: Head) -> None:
        names = [m.name for m in MUSCLES if m.base != "masseter"]
        assert list(head.fields) == [*names, "lip_tuck"] == list(required_fields())
        assert all(1.0 < np.linalg.norm(f.displacement, axis=1).max() < 20.0 for f in head.fields.values())

    def test_mesh_is_one_sheet_that_faces_outwards(self, head: Head) -> None:
        sides = np.sort(np.stack([head.quads, np.roll(head.quads, -1, axis=1)], -1).reshape(-1, 2), axis=1)
        assert set(np.unique(sides, axis=0, return_counts=True)[1]) == {1, 2}
        assert len(np.unique(head.quads)) == len(head.rest)
        middle = head.rest[head.quads].mean(axis=1)
        normal = np.cross(*(head.rest[head.quads[:, k + 2]] - head.rest[head.quads[:, k]] for k in (0, 1)))
        crown = middle[:, 1] > 60.0
        assert ((normal * middle)[crown].sum(axis=1) > 0.0).all()

    def test_mirror(self, head: Head) -> None:
        flip = np.array([-1.0, 1.0, 1.0])
        assert (head.mirror[head.mirror] == np.arange(len(head.rest))).all()
        assert np.abs(head.rest[head.mirror] * flip - head.rest).max() < 1e-4
        assert np.abs(head.jaw_weight[head.mirror] - head.jaw_weight).max() < 1e-6
        for mask in head.masks.values():
            assert np.abs(mask[head.mirror] - mask).max() < 1e-6

    @pytest.mark.parametrize("base", sorted({m.base for m in MUSCLES if m.side}))
    def test_right_field_mirrors_the_left(self, head: Head, base: str) -> None:
        left, right = (dense(head, head.fields[f"{base}.{side}"]) for side in ("left", "right"))
        assert np.abs(left[head.mirror] * [-1.0, 1.0, 1.0] - right).max() < 0.005

    @pytest.mark.parametrize(
        "name", ["orbicularis_oris_funneler", "orbicularis_oris_presser", "lip_tuck", "jaw"]
    )
    def test_what_has_no_side_is_symmetric(self, head: Head, name: str) -> None:
        field = dense(head, head.jaw_corrective if name == "jaw" else head.fields[name])
        assert np.abs(field[head.mirror] * [-1.0, 1.0, 1.0] - field).max() < 0.005

    def test_left_muscle_moves_the_left(self, head: Head) -> None:
        for name in ("zygomatic_major", "frontalis_lateralis", "orbicularis_oculi_palpebralis"):
            field = head.fields[f"{name}.left"]
            strength = np.linalg.norm(field.displacement, axis=1)
            assert (strength * head.rest[field.vertices, 0]).sum() > 0.0

    def test_lips_are_together_at_rest(self, head: Head) -> None:
        points = head.landmarks(head.skin.matrix @ head.rest)
        gaps = points[[61, 62, 63], 1] - points[[67, 66, 65], 1]
        assert (np.abs(gaps) < 0.3).all()
        assert (
            np.linalg.norm(head.rest[head.lip_pairs[:, 0]] - head.rest[head.lip_pairs[:, 1]], axis=1).max()
            < 2.2
        )

    def test_lids_meet_when_closed_and_stand_open_at_rest(self, head: Head) -> None:
        closed = posed(head, orbicularis_oculi_palpebralis=1.0)
        for pairs in head.lid_pairs:
            middle = pairs[len(pairs) // 4 : -len(pairs) // 4]
            assert (head.rest[middle[:, 0], 1] - head.rest[middle[:, 1], 1]).min() > 3.0
            assert np.abs(closed[pairs[:, 0], 1] - closed[pairs[:, 1], 1]).max() < 0.1

    def test_blink_clears_the_eyeball(self, head: Head) -> None:
        for amount in (0.0, 0.3, 0.6, 1.0):
            margin = posed(head, orbicularis_oculi_palpebralis=amount)[np.concatenate(head.lid_pairs).ravel()]
            centre = head.eye_centre[(margin[:, 0] < 0.0).astype(int)]
            assert (np.linalg.norm(margin - centre, axis=1) - head.eye_radius[0]).min() > -0.3

    def test_jaw_opens_the_mouth(self, head: Head) -> None:
        opened = head.landmarks(head.skin.matrix @ posed(head, masseter=1.0))
        assert 20.0 < opened[62, 1] - opened[66, 1] < 45.0
        assert head.jaw_weight[head.rest[:, 1] > 0.0].max() < 0.2

    def test_tuck_brings_the_lower_lip_to_the_incisors(self, head: Head) -> None:
        teeth = head.teeth_upper
        front = (teeth.material == 0.0) & (np.abs(teeth.vertices[:, 0]) < 6.0)
        edge = teeth.vertices[front, 1].min()
        skin = head.skin.matrix @ posed(head, lip_tuck=1.0, masseter=0.06)
        lower = (np.abs(skin[:, 0]) < 2.0) & (head.skin.matrix @ head.masks["lips"] > 0.5)
        lower &= head.skin.matrix @ head.jaw_weight > 0.5
        assert abs(skin[lower, 1].max() - edge) < 0.6

    def test_neck_takes_the_rotation_smoothly(self, head: Head) -> None:
        face = (head.rest[:, 1] > -85.0) & (head.rest[:, 2] > -25.0)
        assert head.neck_weight[face].min() > 0.999
        assert head.neck_weight[head.rest[:, 1] < -220.0].max() < 0.01

    def test_teeth_stand_behind_the_closed_lips(self, head: Head) -> None:
        line = head.landmarks(head.skin.matrix @ head.rest)[62]
        upper, lower = head.teeth_upper, head.teeth_lower
        assert len(upper.vertices) + len(lower.vertices) < 8000
        for mesh in (upper, lower):
            assert set(np.unique(mesh.material)) == {0.0, 1.0}
            assert mesh.vertices[:, 2].max() < line[2] - 1.0
            assert np.abs(np.sort(mesh.vertices[:, 0]) + np.sort(mesh.vertices[:, 0])[::-1]).max() < 1e-3
        incisors = upper.vertices[(upper.material == 0.0) & (np.abs(upper.vertices[:, 0]) < 6.0)]
        assert 1.0 < line[1] - incisors[:, 1].min() < 3.0

    def test_tongue_reaches_the_ridge_passes_the_teeth_and_draws_back(self, head: Head) -> None:
        tip = int(np.argmax(head.tongue.rest[:, 2]))
        moved = {}
        for name, field in head.tongue.fields.items():
            points = head.tongue.rest.copy()
            points[field.vertices] += field.displacement
            moved[name] = points[tip] - head.tongue.rest[tip]
        incisors = head.teeth_upper.vertices[:, 2].max()
        assert moved["tongue_up"][1] > 8.0
        assert head.tongue.rest[tip, 2] + moved["tongue_out"][2] > incisors
        assert moved["tongue_back"][2] < -5.0

    def test_landmarks_are_numbered_from_the_subjects_right(self, head: Head) -> None:
        assert head.landmark_weights.sum(axis=1) == pytest.approx(np.ones(68), abs=1e-5)
        points = head.landmarks(head.skin.matrix @ head.rest)
        assert np.abs(points[IBUG_MIRROR] * [-1.0, 1.0, 1.0] - points).max() < 0.3
        right = [0, 3, 17, 19, 31, 36, 39, 48, 49, 60]
        assert (points[right, 0] < 0.0).all()
        assert points[8, 1] == points[:, 1].min()
        assert points[19, 1] > points[37, 1] > points[41, 1] > points[30, 1] > points[51, 1] > points[57, 1]

    @pytest.mark.parametrize("side", [0, 1])
    def test_eyes_fill_their_openings(self, head: Head, side: int) -> None:
        margin = head.rest[head.lid_pairs[side].ravel()]
        distance = np.linalg.norm(margin - head.eye_centre[side], axis=1) - head.eye_radius[side]
        assert -0.5 < distance.min() < distance.max() < 4.0
        assert np.sign(head.eye_centre[side, 0]) == (1.0, -1.0)[side]
