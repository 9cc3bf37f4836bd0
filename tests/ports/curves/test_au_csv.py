from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from risorius.api import play, pose
from risorius.core.parameters import INDEX
from risorius.errors import InputError, RisoriusWarning
from risorius.ports.curves.au_csv import CAMERA, COLUMNS, pose_angles, read_au_csv, turn_of
from risorius.settings import Settings
from risorius.take import Take


@pytest.fixture(scope="module")
def written(clip: Take, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("au") / "x.au.csv"
    clip.write(path)
    return path


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty"),
        ("frame, AU01_r\n1, 0.5", "column 'timestamp' of OpenFace is missing"),
        (
            "timestamp, AU_01\n0, 1",
            ":1: column 'AU01_r' of OpenFace is missing; the nearest is 'AU_01'",
        ),
        ("timestamp, AU99_r\n0, 1", ":1:12: unknown action unit"),
        ("timestamp, AU01_r\n0, x", ":2:4: AU01_r is 'x'; expected a number"),
        ("timestamp, AU01_r\n0", ":2: has 1 values; expected 2"),
        ("timestamp, succes, AU01_r\n0, 1, 1", ":1:12: unknown column 'succes'; did you mean 'success'"),
        ("timestamp, AU01_r, AU01_R\n0, 1, 1", "column 'AU01_r' is given twice"),
        (
            "timestamp, AU01_r, pose_Rx\n0, 1, 0",
            "column 'pose_Ry' of OpenFace is missing; the nearest is 'pose_Rx'",
        ),
        (
            "timestamp, AU01_r, gaze_angle_x, gaze_angle_y\n0, 1, 0, 40",
            ":2:10: gaze_angle_y is '40'; expected radians",
        ),
        ("timestamp, AU01_r\n0, 1\n90000, 1", ":3: the capture lasts 90000 s; expected at most 21600 s"),
        ("timestamp, AU01_r\n0.1, 1\n0.1, 1", ":3: its time does not come after"),
        ("timestamp, success, AU01_r\n0, 0, 1", "no row has success 1"),
        ("timestamp, AU01_r, AU12_x\n0, 1, 1", "unknown column 'AU12_x'; did you mean 'AU12_"),
        ("timestamp, AU01_r\n0, inf", "expected a number"),
    ],
)
def test_bad_files_are_one_line(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "x.au.csv").write_text(text)
    with pytest.raises(InputError, match=message):
        read_au_csv(tmp_path / "x.au.csv")


def test_columns_are_openface_s(written: Path, clip: Take) -> None:
    lines = written.read_text().splitlines()
    assert lines[0].startswith(
        "frame, face_id, timestamp, confidence, success, gaze_0_x, gaze_0_y, gaze_0_z, gaze_1_x"
    )
    assert lines[0].endswith("AU25_c, AU26_c, AU28_c, AU45_c")
    assert sum(name.endswith("_r") for name in COLUMNS) == 17
    assert sum(name.endswith("_c") for name in COLUMNS) == 18
    assert len(lines) == 1 + len(clip.times)
    row = dict(zip(COLUMNS, lines[4].split(", "), strict=True))
    assert row["frame"] == "4"
    assert row["timestamp"] == "0.300"
    assert np.linalg.norm([float(row[f"gaze_0_{axis}"]) for axis in "xyz"]) == pytest.approx(1.0, abs=1e-5)


def test_a_smile_is_au12_and_present(tmp_path: Path) -> None:
    pose({"AU12": 0.8, "AU6": 0.5, "AU1": 0.1}).write(tmp_path / "x.au.csv")
    header, row, *_ = (tmp_path / "x.au.csv").read_text().splitlines()
    cells = dict(zip(header.split(", "), row.split(", "), strict=True))
    assert float(cells["AU12_r"]) == pytest.approx(4.0, abs=0.3)
    assert (cells["AU12_c"], cells["AU06_c"], cells["AU01_c"], cells["AU15_c"]) == ("1", "1", "0", "0")


def test_frames_without_a_face_hold_the_last_one(tmp_path: Path) -> None:
    (tmp_path / "x.csv").write_text("timestamp,success,AU12_r\n0.0,0,5\n0.1,1,1\n0.2,0,4\n0.3,1,2\n")
    assert read_au_csv(tmp_path / "x.csv").units[12].tolist() == [0.2, 0.2, 0.2, 0.4]


def test_angles_go_there_and_back() -> None:
    angles = (0.2, -0.4, 0.1)
    assert pose_angles(turn_of(np.array(angles))) == pytest.approx(angles)
    assert np.allclose(CAMERA @ CAMERA, np.eye(3))


@pytest.mark.parametrize("name", ["x.csv", "MyTake.CSV", "x.au.csv", "x.arkit.csv"])
def test_a_file_of_openface_is_known_by_its_columns(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text("frame, face_id, timestamp, success, AU12_r\n1,0,0.0,1,5\n2,0,0.1,1,5\n")
    take = play(tmp_path / name, settings=Settings(fps=Fraction(30)))
    assert take.performance.values[1, INDEX["zygomatic_major.left"]] > 0.5


@pytest.mark.parametrize(("fps", "times"), [(30, (0.0, 1.0, 2.315)), (25, (0.0, 0.5, 0.53)), (7, (0.0, 0.9))])
def test_a_capture_that_ends_between_frames_keeps_its_last_face(
    tmp_path: Path, fps: int, times: tuple[float, ...]
) -> None:
    rows = "".join(f"{time},0,{0.3 * time / times[-1]},0,0\n" for time in times)
    (tmp_path / "x.au.csv").write_text("timestamp,AU12_r,pose_Rx,pose_Ry,pose_Rz\n" + rows)
    take = play(tmp_path / "x.au.csv", settings=Settings(fps=Fraction(fps)))
    pitch = take.performance.values[:, INDEX["head_pitch"]]
    assert len(pitch) == round(times[-1] * fps) + 1
    assert abs(pitch[-1]) == pytest.approx(np.degrees(0.3), rel=0.1)


@pytest.mark.parametrize("start", [0.259, 0.5])
def test_times_are_those_of_the_film(tmp_path: Path, start: float) -> None:
    (tmp_path / "x.au.csv").write_text(f"timestamp,AU12_r\n{start},1\n{start + 1},5\n")
    assert read_au_csv(tmp_path / "x.au.csv").times.tolist() == pytest.approx([start, start + 1.0])


def test_a_late_beginning_is_told_and_a_clock_begins_at_0(tmp_path: Path) -> None:
    (tmp_path / "x.au.csv").write_text("timestamp,AU12_r\n100,1\n101,5\n")
    with pytest.warns(RisoriusWarning, match=r":2: the first row is at 100 s, and is held from 0 s on"):
        assert read_au_csv(tmp_path / "x.au.csv").times.tolist() == [100.0, 101.0]
    (tmp_path / "x.au.csv").write_text("timestamp,AU12_r\n1700000000.5,1\n1700000001.5,5\n")
    assert read_au_csv(tmp_path / "x.au.csv").times.tolist() == [0.0, 1.0]


FACES = (
    "frame,face_id,timestamp,success,AU12_r\n"
    "1,0,0.0,1,1\n1,3,0.0,1,4\n2,0,0.1,1,2\n2,3,0.1,1,5\n3,3,0.2,1,3\n"
)


def test_one_of_several_faces_is_chosen_by_its_number(tmp_path: Path) -> None:
    (tmp_path / "x.csv").write_text(FACES)
    assert read_au_csv(tmp_path / "x.csv", 0).units[12].tolist() == pytest.approx([0.2, 0.4])
    assert read_au_csv(tmp_path / "x.csv", 3).units[12].tolist() == pytest.approx([0.8, 1.0, 0.6])
    with pytest.raises(InputError, match=r"has 2 faces: 0, 3; expected one of them, e\.g\. --face 0"):
        read_au_csv(tmp_path / "x.csv")
    with pytest.raises(InputError, match="has no face 1; expected one of 0, 3"):
        read_au_csv(tmp_path / "x.csv", 1)


def test_a_number_of_a_face_is_refused_where_faces_have_none(tmp_path: Path) -> None:
    (tmp_path / "x.au.csv").write_text("timestamp,AU12_r\n0,1\n1,5\n")
    with pytest.raises(InputError, match="has no column 'face_id'; expected no --face"):
        play(tmp_path / "x.au.csv", face=0)
    (tmp_path / "x.fap").write_text("")
    with pytest.raises(InputError, match="holds one face; expected no --face"):
        play(tmp_path / "x.fap", face=0)


def test_the_last_frame_is_held_although_the_file_rounds_its_time(tmp_path: Path) -> None:
    """Row 8 of 30 per second stands at .233, frame 7 at .23333: it must not fall back to rest."""
    header = "timestamp, AU01_r, AU12_r, pose_Rx, pose_Ry, pose_Rz"
    rows = [f"{number / 30:.3f}, 0, 3, 0.1, 0, 0" for number in range(8)]
    (tmp_path / "x.au.csv").write_text("\n".join([header, *rows]))
    curves = play(tmp_path / "x.au.csv", settings=Settings(dynamics="static")).curves
    assert len(curves["head_pitch"]) == 8
    assert curves["head_pitch"][-1] == pytest.approx(curves["head_pitch"][3])
    assert abs(curves["head_pitch"][-1]) > 5.0
