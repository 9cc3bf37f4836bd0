from pathlib import Path

import numpy as np
import pytest

from risorius.api import play, pose
from risorius.core.parameters import INDEX
from risorius.errors import InputError, RisoriusWarning
from risorius.settings import Settings
from risorius.speech.recordings.recording import read_recording
from risorius.take import Take


@pytest.fixture(scope="module")
def folder(clip: Take, tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = tmp_path_factory.mktemp("captures")
    names = ("x.arkit.csv", "x.au.csv", "x.fap", "x.score.json", "x.performance.json", "x.wav")
    clip.write(*(found / name for name in names))
    return found


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("x.bvh", "unknown kind of capture '.bvh'; expected one of .arkit.csv"),
        ("none.fap", "cannot be read"),
        ("none.score.json", "cannot be read|no such"),
    ],
)
def test_what_cannot_be_played_is_one_line(tmp_path: Path, name: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        play(tmp_path / name)


def test_a_sound_that_is_none(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "y.wav").write_bytes(b"RIFF1234WAVEjunk")
    with pytest.raises(InputError, match=r"y\.wav: cannot be read"):
        play(folder / "x.fap", audio=tmp_path / "y.wav")


# What comes back is within so many mm, root mean square over the skin of all frames.
@pytest.mark.parametrize(("name", "most"), [("x.arkit.csv", 0.5), ("x.fap", 0.8), ("x.au.csv", 1.5)])
def test_a_capture_of_our_own_face_is_that_face(folder: Path, clip: Take, name: str, most: float) -> None:
    settings = Settings(fps=clip.performance.fps, dynamics="static")
    again = play(folder / name, settings=settings)
    for parameter in ("head_yaw", "head_pitch", "gaze_yaw", "gaze_pitch"):
        # FAP angles are whole numbers of 1e-5 rad; OpenFace's have six decimals.
        assert np.abs(again.curves[parameter] - clip.curves[parameter])[1:-1].max() < 0.3, parameter
    pairs = zip(clip.faces(), again.faces(), strict=True)
    apart = [np.linalg.norm(a.skin - b.skin, axis=1) for a, b in pairs]
    assert np.sqrt(np.mean(np.square(apart))) < most


@pytest.mark.parametrize("name", ["x.score.json", "x.performance.json"])
def test_a_score_gives_the_same_curves(folder: Path, clip: Take, name: str) -> None:
    settings = Settings(fps=clip.performance.fps)
    assert (
        np.abs(play(folder / name, settings=settings).performance.values - clip.performance.values).max()
        < 1e-9
    )


def test_points_that_say_nothing_of_the_face_leave_it_at_rest(tmp_path: Path) -> None:
    mask = " ".join("1" if number == 48 else "0" for number in range(1, 69))
    (tmp_path / "x.fap").write_text(f"2.1 x 10 2\n{mask}\n0 0\n{mask}\n1 10000\n")
    take = play(tmp_path / "x.fap", settings=Settings(dynamics="static"))
    assert take.curves["head_pitch"][-1] == pytest.approx(-np.degrees(0.1))
    assert {name for name, curve in take.curves.items() if np.ptp(curve)} == {"head_pitch"}


def test_the_tongue_comes_back_from_its_tip(tmp_path: Path) -> None:
    pose({"tongue_out": 0.7, "masseter": 0.3}).write(tmp_path / "out.fap")
    pose({"tongue_up": 0.8, "masseter": 0.3}).write(tmp_path / "up.fap")
    out, up = (
        play(tmp_path / name, settings=Settings(dynamics="static")).curves for name in ("out.fap", "up.fap")
    )
    assert out["tongue_out"][0] == pytest.approx(0.7, abs=0.25)
    assert up["tongue_up"][0] > 0.5 > up["tongue_out"][0] + 0.2


def test_what_our_face_cannot_show_of_a_capture_is_said(tmp_path: Path) -> None:
    mask = " ".join("1" if number in (1, 39, 48) else "0" for number in range(1, 69))
    (tmp_path / "x.fap").write_text(f"2.1 x 10 1\n{mask}\n0 3 200 100\n")
    with pytest.warns(RisoriusWarning, match=r"x.fap: FAP 1, 39 cannot be shown; left out"):
        play(tmp_path / "x.fap")


def test_lips_closed_over_an_open_jaw_are_closed_by_contact(folder: Path, tmp_path: Path) -> None:
    header, first, *_ = (folder / "x.arkit.csv").read_text().splitlines()
    cells = dict(zip(header.split(","), first.split(","), strict=True))
    rows = []
    for frame in range(3):
        chosen = dict.fromkeys(cells, "0.0") | {"JawOpen": "0.3", "MouthClose": "0.3"}
        chosen |= {"Timecode": f"00:00:00:{frame:02d}.000", "BlendshapeCount": "61"}
        rows.append(",".join(chosen.values()))
    (tmp_path / "MySlate_1_iPhone.csv").write_text("\n".join([header, *rows]))
    take = play(tmp_path / "MySlate_1_iPhone.csv", settings=Settings(dynamics="static"))
    assert take.curves["lip_seal"].min() == 1.0
    assert take.curves["masseter"].min() > 0.1


def test_the_sound_goes_along(folder: Path, clip: Take, tmp_path: Path) -> None:
    take = play(folder / "x.arkit.csv", audio=folder / "x.wav", settings=Settings(dynamics="static"))
    take.write(tmp_path / "y.wav")
    one, other = (read_recording(path).read().astype(int) for path in (tmp_path / "y.wav", folder / "x.wav"))
    assert len(one) == len(other)
    assert np.abs(one - other).max() <= 1


def test_curves_know_their_file(folder: Path) -> None:
    take = play(folder / "x.fap", settings=Settings(dynamics="static"))
    (curve,) = take.score.manual
    assert curve.cause.trigger == "x.fap"
    assert set(curve.keys) <= set(INDEX)
