"""Locks on files: on systems with `fcntl` as they are, on Windows as its module promises."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

from risorius.machine import file_lock


@pytest.mark.skipif(sys.platform == "win32", reason="has other locks")
def test_one_may_write_or_several_read(tmp_path: Path) -> None:
    path = tmp_path / "x"
    with path.open("a+b") as one, path.open("a+b") as other:
        file_lock.lock(one, shared=True)
        file_lock.lock(other, shared=True)
        with path.open("a+b") as third, pytest.raises(BlockingIOError):
            file_lock.lock(third)
    with path.open("a+b") as one, path.open("a+b") as other:
        file_lock.lock(one)
        with pytest.raises(BlockingIOError):
            file_lock.lock(other)


def _on_windows(monkeypatch: pytest.MonkeyPatch, locking: object) -> ModuleType:
    """Return the module as Windows loads it, with a stand-in for `msvcrt`."""
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setitem(sys.modules, "msvcrt", SimpleNamespace(LK_NBLCK=2, locking=locking))
    monkeypatch.setitem(sys.modules, "fcntl", None)  # cannot be imported there
    spec = importlib.util.spec_from_file_location("file_lock_on_windows", file_lock.__file__)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_windows_locks_a_byte_beyond_what_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    locked: list[tuple[int, int]] = []
    module = _on_windows(monkeypatch, lambda number, mode, count: locked.append((mode, count)))
    with (tmp_path / "x").open("a+b") as file:
        module.lock(file, shared=True)
        assert locked == []
        module.lock(file)
        assert locked == [(2, 1)]
        assert file.tell() == 0


def test_a_file_that_windows_has_locked_is_told_alike(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(number: int, mode: int, count: int) -> None:
        raise PermissionError(13, "denied")

    module = _on_windows(monkeypatch, refuse)
    with (tmp_path / "x").open("a+b") as file, pytest.raises(BlockingIOError):
        module.lock(file)
