import os
from pathlib import Path

import pytest

from risorius.ports.video import slots
from risorius.ports.video.slots import Slots, map_slots


def test_what_is_written_into_a_slot_is_read_by_its_other_user() -> None:
    mine = Slots(3, 1000)
    theirs = map_slots(str(mine.path))
    mine.slot(1)[:] = b"b" * 1000
    mine.slot(2)[:] = b"c" * 1000
    assert bytes(theirs) == bytes(1000) + b"b" * 1000 + b"c" * 1000
    mine.close()


def test_no_file_is_left_once_both_have_the_memory() -> None:
    mine = Slots(2, 10)
    assert mine.path.stat().st_size == 20
    map_slots(str(mine.path))
    assert not mine.path.exists()
    mine.close()
    never_mapped = Slots(2, 10)
    never_mapped.close()
    assert not never_mapped.path.exists()


@pytest.mark.skipif(not hasattr(os, "posix_fallocate"), reason="needs posix_fallocate")
def test_without_room_in_memory_the_slots_are_made_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(slots, "IN_MEMORY", str(tmp_path / "missing"))
    monkeypatch.setattr(slots.tempfile, "gettempdir", lambda: str(tmp_path))
    mine = Slots(1, 5)
    assert mine.path.parent == tmp_path
    mine.close()
    assert list(tmp_path.iterdir()) == []
