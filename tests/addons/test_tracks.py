"""What the add-on for Blender reads: our files, and takes of the app; nothing here needs Blender."""

from __future__ import annotations

import importlib.util
import json
import sys
from fractions import Fraction
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import risorius
from risorius.core.arkit import CSV_SHAPES
from risorius.ports.curves.arkit_csv import COLUMNS, COUNT, read_arkit_csv, timecode

ADDON = Path(__file__).parents[2] / "addons/blender/risorius_performance"


@pytest.fixture(scope="module")
def tracks() -> ModuleType:
    spec = importlib.util.spec_from_file_location("risorius_blender_tracks", ADDON / "tracks.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look it up
    spec.loader.exec_module(module)
    return module


def written(path: Path, fps: Fraction, frames: int) -> Path:
    """Write a take in which each value is its own, as the port writes it."""
    rows = [",".join(COLUMNS)]
    for k in range(frames):
        values = [(k + 1) * (c + 1) / 10_000 for c in range(COUNT)]
        rows.append(f"{timecode(k, fps)},{COUNT},{','.join(f'{value:.10f}' for value in values)}")
    path.write_text("\n".join(rows) + "\n")
    return path


@pytest.mark.parametrize("fps", [Fraction(60), Fraction(30), Fraction(25), Fraction(24000, 1001)])
def test_a_take_is_read_as_the_library_reads_it(tracks: ModuleType, fps: Fraction, tmp_path: Path) -> None:
    path = written(tmp_path / "x.arkit.csv", fps, 100)
    track, ours = tracks.read_track(path), read_arkit_csv(path)
    np.testing.assert_allclose(track.times, ours.times - ours.times[0], atol=1e-9)
    assert track.rate == pytest.approx(float(fps), abs=0.005)
    assert set(track.values) == set(CSV_SHAPES)
    assert track.values["JawOpen"][7] == pytest.approx(8 * (CSV_SHAPES.index("JawOpen") + 1) / 10_000)
    yaw, pitch, roll = np.degrees(ours.rotations[7, :3])
    assert [track.head[part][7] for part in ("pitch", "yaw", "roll")] == pytest.approx([pitch, yaw, roll])


def test_a_performance_is_read(tracks: ModuleType, tmp_path: Path) -> None:
    take = risorius.speak("Hi.", settings=risorius.Settings(fps="24000/1001"))
    take.write(tmp_path / "x.performance.json")
    track = tracks.read_track(tmp_path / "x.performance.json")
    np.testing.assert_allclose(track.times, take.times, atol=1e-9)
    np.testing.assert_allclose(track.values["masseter"], take.curves["masseter"], atol=1e-9)
    np.testing.assert_allclose(track.head["pitch"], take.curves["head_pitch"], atol=1e-9)
    assert not any(name.startswith(("head_", "gaze_")) for name in track.values)


@pytest.mark.parametrize(
    ("rate", "frames", "seconds"),
    [
        (30.0, 30, 1.0),
        (24000 / 1001, 24, 1.001),
        (23.98, 24, 1.001),
        (29.97, 30, 1.001),
        (59.94, 60, 1.001),
        (12.5, 13, 1.04),
        (0.4, 1, 2.5),
    ],
)
def test_blender_states_a_rate_by_frames_and_seconds(
    tracks: ModuleType, rate: float, frames: int, seconds: float
) -> None:
    assert tracks.scene_rate(rate) == (frames, pytest.approx(seconds))


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("x.wav", "", "x.wav: is not a performance; expected .arkit.csv or .performance.json"),
        ("x.csv", "a,b\n1,2\n", "x.csv: has no frames with a Timecode"),
        ("x.csv", "", "x.csv: cannot be read"),
        ("x.csv", "Timecode,JawOpen\nsoon,1\n", "x.csv: 'soon' is not a time code"),
        ("x.csv", "Timecode,JawOpen\n00:00:00:00.000,wide\n", "x.csv: cannot be read"),
        ("x.json", "{", "x.json: cannot be read"),
        ("x.json", "[]", "x.json: has no curves"),
        ("x.json", json.dumps({"fps": 30, "curves": {}}), "x.json: has no curves"),
    ],
)
def test_what_cannot_be_read_is_one_line(
    tracks: ModuleType, name: str, content: str, message: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_text(content)
    with pytest.raises(tracks.TrackError) as caught:
        tracks.read_track(path)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("jawOpen", "JawOpen"),
        ("jawOpen", "Jaw_Open"),
        ("browDownLeft", "browDown_L"),
        ("zygomatic_major.left", "Zygomatic Major L"),
    ],
)
def test_names_are_compared_without_their_spelling(tracks: ModuleType, one: str, other: str) -> None:
    assert tracks.plain(one) == tracks.plain(other)
    assert tracks.plain("browDownLeft") != tracks.plain("browDown_R")


def test_a_map_is_the_one_that_rig_prints(tracks: ModuleType, tmp_path: Path) -> None:
    path = tmp_path / "map.toml"
    path.write_text('# 1 of 52\n[shapes]\njawOpen = "Mouth_Open"\n')
    assert tracks.read_map(path) == {"jawOpen": ("Mouth_Open",)}
    path.write_text('[shapes]\njawOpen = ["Mouth_Open", "Teeth_Open"]\n')
    assert tracks.read_map(path) == {"jawOpen": ("Mouth_Open", "Teeth_Open")}
    for wrong in ("5", "[5]"):
        path.write_text(f"[shapes]\njawOpen = {wrong}\n")
        with pytest.raises(tracks.TrackError, match="has no table of names"):
            tracks.read_map(path)
