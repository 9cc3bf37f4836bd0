from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from risorius.errors import RisoriusWarning
from risorius.machine import array_cache as module
from risorius.machine.array_cache import cached_arrays

GIVEN = [np.arange(3.0), np.eye(2, dtype=np.float32)]
FOUND = (np.array([1.5, np.nan]), np.arange(4, dtype=np.int32).reshape(2, 2))


class Finder:
    """Counts how often something had to be found."""

    def __init__(self) -> None:
        self.times = 0

    def __call__(self) -> tuple[np.ndarray, ...]:
        self.times += 1
        return FOUND


@pytest.fixture
def find(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Finder:
    monkeypatch.setenv("RISORIUS_CACHE_DIR", str(tmp_path / "cache"))
    return Finder()


def files(tmp_path: Path) -> list[Path]:
    return sorted((tmp_path / "cache" / "arrays").iterdir())


def test_a_damaged_file_is_found_anew(find: Finder, tmp_path: Path) -> None:
    cached_arrays("x", GIVEN, find)
    (file,) = files(tmp_path)
    for damage in (b"", b"no zip", file.read_bytes()[:100]):
        file.write_bytes(damage)
        np.testing.assert_array_equal(cached_arrays("x", GIVEN, find)[1], FOUND[1])
    assert find.times == 4


def test_a_folder_that_cannot_be_written_costs_time_only(find: Finder, tmp_path: Path) -> None:
    (tmp_path / "cache").write_text("no folder")
    with pytest.warns(RisoriusWarning, match="cannot be written"):
        np.testing.assert_array_equal(cached_arrays("x", GIVEN, find)[0], FOUND[0])


def test_what_is_kept_comes_back_as_it_was(find: Finder, tmp_path: Path) -> None:
    cached_arrays("x", GIVEN, find)
    for stored, found in zip(cached_arrays("x", GIVEN, find), FOUND, strict=True):
        np.testing.assert_array_equal(stored, found)
        assert stored.dtype == found.dtype
    assert find.times == 1
    assert len(files(tmp_path)) == 1


@pytest.mark.parametrize(
    "other",
    [
        [np.arange(3.0), np.eye(2)],
        [np.arange(3.0).reshape(3, 1), GIVEN[1]],
        [np.arange(3.0) + 1e-12, GIVEN[1]],
        GIVEN[:1],
    ],
    ids=["type", "shape", "value", "number"],
)
def test_another_input_is_another_file(find: Finder, other: list[np.ndarray]) -> None:
    cached_arrays("x", GIVEN, find)
    cached_arrays("x", other, find)
    assert find.times == 2


def test_another_source_is_another_file(find: Finder, monkeypatch: pytest.MonkeyPatch) -> None:
    cached_arrays("x", GIVEN, find)
    monkeypatch.setattr(module.cache_folder, "sources", lambda: "changed")
    cached_arrays("x", GIVEN, find)
    assert find.times == 2


def test_what_a_killed_process_left_is_removed(find: Finder, tmp_path: Path) -> None:
    cached_arrays("x", [np.array(1)], find)
    old, young = (files(tmp_path)[0].with_name(name) for name in ("old.part", "young.part"))
    for left in (old, young):
        left.touch()
    os.utime(old, (0, 0))
    cached_arrays("x", [np.array(2)], find)
    assert (old.exists(), young.exists()) == (False, True)


def test_old_files_make_room(find: Finder, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_FILES", 3)
    for k in range(5):
        cached_arrays("x", [np.array(k)], find)
    assert len(files(tmp_path)) == 3
