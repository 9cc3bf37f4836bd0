import errno
import os
from pathlib import Path

import pytest

from risorius.errors import OutputError
from risorius.machine.atomic import replacing


class Stop(BaseException):
    """Stands for an interrupt."""


@pytest.mark.parametrize("error", [ValueError, Stop])
def test_after_an_exception_nothing_new_is_left_and_the_old_file_stays(
    tmp_path: Path, error: type[BaseException]
) -> None:
    target = tmp_path / "x.txt"
    target.write_text("old")
    with pytest.raises(error), replacing(target) as temporary:  # noqa: PT012 - the block is the subject
        temporary.write_text("half")
        raise error
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_an_interrupt_at_the_moment_of_creation_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    close = os.close

    def close_and_stop(file: int) -> None:
        close(file)
        raise Stop

    monkeypatch.setattr("risorius.machine.atomic.os.close", close_and_stop)
    with pytest.raises(Stop), replacing(tmp_path / "x.txt"):
        pass
    monkeypatch.undo()
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_is_one_line(tmp_path: Path) -> None:
    target = tmp_path / "x.txt"
    with (
        pytest.raises(OutputError, match=r"x\.txt: no space left on the disk; nothing was written$"),
        replacing(target),
    ):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    assert list(tmp_path.iterdir()) == []


def test_a_missing_folder_is_one_line_without_the_temporary_name(tmp_path: Path) -> None:
    target = tmp_path / "none" / "x.txt"
    with pytest.raises(OutputError) as caught, replacing(target):
        pass
    assert str(caught.value) == f"{target}: cannot be written: No such file or directory"


def test_a_fault_of_another_file_names_it(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"x\.txt: cannot be written: .*\(.*voice\.wav\)$"):  # noqa: SIM117
        with replacing(tmp_path / "x.txt"):
            (tmp_path / "voice.wav").read_bytes()


def test_nothing_is_seen_before_the_end(tmp_path: Path) -> None:
    target = tmp_path / "x.txt"
    with replacing(target) as temporary:
        temporary.write_text("whole")
        assert temporary.parent == tmp_path
        assert not target.exists()
    assert target.read_text() == "whole"
    assert list(tmp_path.iterdir()) == [target]


def test_a_new_file_has_the_usual_permissions(tmp_path: Path) -> None:
    (tmp_path / "usual").write_text("")
    with replacing(tmp_path / "x.txt"):
        pass
    assert (tmp_path / "x.txt").stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_a_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "far").mkdir()
    real, link = tmp_path / "far" / "real.txt", tmp_path / "link.txt"
    real.write_text("old")
    link.symlink_to(real)
    with replacing(link) as temporary:
        temporary.write_text("new")
    assert link.is_symlink()
    assert real.read_text() == "new"


def test_what_a_killed_process_left_a_day_ago_is_removed(tmp_path: Path) -> None:
    old, young, other = (tmp_path / name for name in (".risorius-1.part", ".risorius-2.part", "3.part"))
    for left in (old, young, other):
        left.write_text("half")
    for left in (old, other):
        os.utime(left, (0, 0))
    with replacing(tmp_path / "x.txt") as temporary:
        temporary.write_text("whole")
    assert {path.name for path in tmp_path.iterdir()} == {young.name, other.name, "x.txt"}
