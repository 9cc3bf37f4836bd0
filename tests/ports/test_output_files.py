import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest

from risorius.core.arrays import ByteArray
from risorius.core.speech.audio import Audio
from risorius.core.speech.utterance import Utterance
from risorius.errors import OutputError
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.formats import FORMATS, Need
from risorius.ports.output_files import check_target, check_targets, write_targets

TakeMaker = Callable[..., WritableTake]
NOWHERE = Path("/proc")


def test_a_missing_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(
        OutputError, match=r"x\.mp4: the folder '.*none' does not exist; expected an existing folder$"
    ):
        check_target(tmp_path / "none" / "x.mp4")


def test_a_file_in_place_of_a_folder_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match=r"'.*file' is not a folder$"):
        check_target(tmp_path / "file" / "x.mp4")


def test_a_folder_as_target_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.mp4").mkdir()
    with pytest.raises(OutputError, match=r"x\.mp4: is a folder; expected a file name$"):
        check_target(tmp_path / "x.mp4")


@pytest.mark.skipif(not NOWHERE.is_dir(), reason="needs a folder in which nobody can write")
def test_an_unwritable_folder_is_named() -> None:
    with pytest.raises(OutputError, match=r"x\.mp4: the folder '/proc' is not writable"):
        check_target(NOWHERE / "x.mp4")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_without_permission_is_named(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(OutputError, match="is not writable"):
        check_target(tmp_path / "x.mp4")
    tmp_path.chmod(0o700)


def test_a_read_only_file_is_respected(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "x.mp4").write_text("")
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(OutputError, match=r"x\.mp4: exists and is read-only$"):
        check_target(tmp_path / "x.mp4")


@pytest.mark.parametrize("name", ["a\0.mp4", "n" * 5000 + ".mp4"])
def test_an_impossible_name_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(OutputError):
        check_target(tmp_path / name)


def test_a_need_that_is_not_available_is_named(tmp_path: Path) -> None:
    with pytest.raises(
        OutputError,
        match=r"x\.wav: \.wav needs spoken words, and there are none; expected one of \.muscles\.csv, ",
    ):
        check_target(tmp_path / "x.wav", {"curves"})
    assert check_target(tmp_path / "x.muscles.csv", {"curves"}).format.suffix == ".muscles.csv"


def test_one_bad_output_among_many_stops_all(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="unknown suffix"):
        check_targets([tmp_path / "x.mp4", tmp_path / "x.mpx"])
    assert list(tmp_path.iterdir()) == []


def test_the_same_file_twice_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="given twice"):
        check_targets([tmp_path / "x.mp4", tmp_path / "." / "x.mp4"])


def test_when_one_writer_fails_none_of_the_files_appears(tmp_path: Path, take_of: TakeMaker) -> None:
    """The second of three outputs breaks in the middle of its pictures."""

    def pictures(size: tuple[int, int], indices: Sequence[int]) -> Iterator[ByteArray]:
        for index in indices:
            if index == 7:
                raise RuntimeError("broken")
            yield np.zeros((size[1], size[0], 3), np.uint8)

    take = take_of(pictures=pictures)
    old = tmp_path / "x.muscles.csv"
    old.write_text("old")
    paths = [old, tmp_path / "x.mp4", tmp_path / "x.landmarks.csv"]
    with pytest.raises(RuntimeError, match="broken"):
        write_targets(take, check_targets(paths), WriteOptions(size=(32, 32)))
    assert old.read_text() == "old"
    assert list(tmp_path.iterdir()) == [old]


def test_a_take_without_sound_gives_an_error_with_the_place(tmp_path: Path, take_of: TakeMaker) -> None:
    with pytest.raises(OutputError, match=r"x\.wav: there is no voice to write"):
        write_targets(take_of(), check_targets([tmp_path / "x.wav"]))
    assert list(tmp_path.iterdir()) == []


def test_all_formats_are_written_twice_with_the_same_bytes(
    tmp_path: Path,
    take_of: TakeMaker,
    sound_of: Callable[..., Audio],
    utterance_of: Callable[..., Utterance],
) -> None:
    utterance = utterance_of("M AA M", lead=0.3, tail=0.4)
    take = take_of(audio=utterance.audio, utterance=utterance)
    suffixes = [suffix[1:] for suffix in FORMATS if Need.HEAD not in FORMATS.get(suffix).needs]
    written = []
    for folder in (tmp_path / "a", tmp_path / "b"):
        folder.mkdir()
        targets = check_targets([folder / f"x.{suffix}" for suffix in suffixes])
        write_targets(take, targets, WriteOptions(size=(64, 48)))
        written.append({path.name: path.read_bytes() for path in folder.iterdir()})
    assert sorted(written[0]) == sorted(f"x.{suffix}" for suffix in suffixes)
    assert written[0] == written[1]
    assert b'"audio": "x.wav"' in written[0]["x.score.json"]
