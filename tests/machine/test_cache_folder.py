"""The folder of what is computed once: chosen by variables, made if it is missing, replaced if need be."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest

from risorius.errors import RisoriusWarning
from risorius.machine import cache_folder


@pytest.fixture(autouse=True)
def forget(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(cache_folder.VARIABLE, "")


def test_the_users_cache_is_the_default(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder.in_use() == tmp_path / "risorius" / "computed"
    assert cache_folder.in_use().is_dir()


def test_a_folder_that_the_user_chose_is_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(cache_folder.VARIABLE, str(tmp_path / "mine"))
    assert cache_folder.in_use() == tmp_path / "mine"


@pytest.mark.parametrize("variable", ["XDG_CACHE_HOME", cache_folder.VARIABLE])
def test_one_that_cannot_be_written_is_replaced_with_one_warning(
    variable: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setenv(variable, str(tmp_path / "file" / "below"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.warns(RisoriusWarning, match="cannot be written: each start computes anew"):
        made = cache_folder.in_use()
    assert made.parent == tmp_path
    assert cache_folder.in_use() == made


def test_without_a_home_a_temporary_folder_is_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def no_home(_path: Path) -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setenv("XDG_CACHE_HOME", "")
    monkeypatch.setattr(Path, "expanduser", no_home)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.warns(RisoriusWarning, match="there is no folder for a cache"):
        assert cache_folder.in_use().parent == tmp_path


def test_any_change_of_a_source_changes_the_digest(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "face").mkdir()
    source = tmp_path / "face" / "kernel.py"
    source.write_text("a = 1\n")
    monkeypatch.setattr(cache_folder, "ROOT", tmp_path)
    before = cache_folder.source_digest()
    source.write_text("a = 2\n")
    assert cache_folder.source_digest() != before
