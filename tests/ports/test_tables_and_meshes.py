"""Formats that hold what others hold too: numpy, Parquet, OBJ, BVH, tiers of channels, BML feedback."""

import xml.etree.ElementTree as ET
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from praatio import textgrid as praatio_textgrid

from risorius.core.movement import Movement
from risorius.core.parameters import NAMES
from risorius.ports.curves.bvh import euler
from risorius.ports.formats import FORMATS, Need
from risorius.ports.score.channels_textgrid import label
from risorius.take import Take


@pytest.fixture(scope="module")
def folder(clip: Take, tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = tmp_path_factory.mktemp("formats")
    names = ("x.npz", "x.vertices.npz", "x.obj", "x.bvh", "x.channels.TextGrid", "x.feedback.xml")
    clip.write(*(found / name for name in names))
    return found


def test_numpy_arrays(folder: Path, clip: Take) -> None:
    with np.load(folder / "x.vertices.npz", allow_pickle=False) as arrays:
        assert arrays["names"].tolist() == list(NAMES)
        assert np.array_equal(arrays["values"], clip.performance.values)
        assert np.array_equal(arrays["time_s"], clip.times)
        skin = arrays["skin"]
    for row, frame in zip(skin, clip.faces(), strict=True):
        assert np.array_equal(row, frame.skin)
    with np.load(folder / "x.npz", allow_pickle=False) as arrays:
        assert set(arrays.files) == {"time_s", "values", "names", "fps"}


def test_parquet(tmp_path: Path, clip: Take) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    clip.write(tmp_path / "x.parquet")
    table = parquet.read_table(tmp_path / "x.parquet")
    assert table.column_names[:2] == ["time_s", NAMES[0]]
    assert np.array_equal(table["masseter"].to_numpy(), clip.curves["masseter"])
    assert table.num_columns == 1 + 46 + 52


def test_an_obj_is_the_middle_frame_turned(folder: Path, clip: Take) -> None:
    lines = (folder / "x.obj").read_text().splitlines()
    groups = [line.split()[1] for line in lines if line.startswith("o ")]
    assert groups[0] == "skin"
    assert {"eye_left", "teeth_lower", "tongue", "hair"} <= set(groups)
    points = np.array([[float(n) for n in line.split()[1:4]] for line in lines if line.startswith("v ")])
    faces = [int(n) for line in lines if line.startswith("f ") for n in line.split()[1:]]
    assert (min(faces), max(faces)) == (1, len(points))
    middle = len(clip.times) // 2
    frame = next(clip.faces([middle]))
    free = np.asarray(clip.head.skin.matrix @ clip.head.neck_weight) == 1.0
    pivot = clip.head.head_pivot
    turned = (frame.skin - pivot) @ frame.head_rotation.T + pivot
    assert np.abs(points[: len(turned)][free] - turned[free]).max() < 1e-3


def test_bvh_angles_make_the_rotations(folder: Path, clip: Take) -> None:
    text = (folder / "x.bvh").read_text()
    motion = text.split("MOTION\n")[1].splitlines()
    assert motion[0] == f"Frames: {len(clip.times)}"
    assert motion[1] == "Frame Time: 0.10000000"
    for row, frame in zip(motion[2:], clip.faces(), strict=True):
        numbers = [float(n) for n in row.split()]
        assert len(numbers) == text.count("rotation ") + text.count("rotation\n") + 3
        z, x, y = np.radians(numbers[6:9])
        made = _about(2, z) @ _about(0, x) @ _about(1, y)
        assert np.abs(made - frame.head_rotation).max() < 1e-6
    assert euler(np.eye(3)) == (0.0, 0.0, 0.0)


def _about(axis: int, angle: float) -> np.ndarray:
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    matrix = np.eye(3)
    matrix[a, a] = matrix[b, b] = np.cos(angle)
    matrix[b, a], matrix[a, b] = np.sin(angle), -np.sin(angle)
    return matrix


def test_every_channel_is_a_tier(folder: Path, clip: Take) -> None:
    grid = praatio_textgrid.openTextgrid(str(folder / "x.channels.TextGrid"), includeEmptyIntervals=True)
    assert grid.tierNames[:2] == ("words", "phones")
    channels = {movement.channel for movement in clip.score.movements}
    assert channels == {name.split("/")[0].split(" ")[0] for name in grid.tierNames[2:]}
    entries = [e for name in grid.tierNames[2:] for e in grid.getTier(name).entries if e.label]
    assert len(entries) == len(clip.score.movements)
    for name in grid.tierNames:
        assert all(a.end <= b.start for a, b in pairwise(grid.getTier(name).entries))


def test_a_movement_is_told_by_its_largest_values() -> None:
    targets = {
        "zygomatic_major.left": 0.25,
        "zygomatic_major.right": 0.5,
        "gaze_yaw": -3.0,
        "gaze_pitch": 0.0,
    }
    movement = Movement("gaze", 0.0, 1.0, 0.1, 0.1, targets)
    assert label(movement) == "zygomatic_major=0.5 gaze_yaw=-3 gaze_pitch=0"


def test_feedback_has_every_word_and_movement(folder: Path, clip: Take) -> None:
    root = ET.fromstring((folder / "x.feedback.xml").read_bytes())
    space = "{http://www.bml-initiative.org/bml/bml-1.0}"
    assert root.tag == f"{space}predictionFeedback"
    assert len(root.findall(f"{space}speech/{space}sync")) == len(clip.utterance.words)
    shown = [e for e in root if e.tag.removeprefix(space) in ("face", "gaze", "head")]
    assert len(shown) == len(clip.score.movements)
    peaks = {"face": "attackPeak", "gaze": "ready", "head": "stroke"}
    for element, movement in zip(shown, clip.score.movements, strict=True):
        kind = element.tag.removeprefix(space)
        face = any(not name.startswith(("head_", "gaze_")) for name in movement.targets)
        assert (kind == "face") == face
        assert kind != "head" or any(name.startswith("head_") for name in movement.targets)
        times = [float(element.get(name)) for name in ("start", peaks[kind], "relax", "end")]
        assert times == sorted(times)


@pytest.mark.full
def test_formats_with_a_head_give_the_same_bytes_twice(tmp_path: Path, clip: Take) -> None:
    slow = (".glb", ".rig.glb", ".vertices.npz")  # these have tests of their own
    suffixes = [s for s in FORMATS if Need.HEAD in FORMATS.get(s).needs and s not in slow]
    for name in ("a", "b"):
        clip.write(*(tmp_path / f"{name}{suffix}" for suffix in suffixes))
    for suffix in suffixes:
        assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"b{suffix}").read_bytes(), suffix
