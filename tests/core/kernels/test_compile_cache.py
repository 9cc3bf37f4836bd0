import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numba
import pytest

from risorius.core.kernels import compile_cache
from risorius.errors import RisoriusWarning

CODE = "import numba, risorius.core.kernels.jit; print(numba.config.CACHE_DIR)"


def _run(**environment: str) -> subprocess.CompletedProcess[str]:
    inherited = {k: v for k, v in os.environ.items() if k not in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")}
    command = [sys.executable, "-c", CODE]
    return subprocess.run(command, env=inherited | environment, capture_output=True, text=True, check=True)


def _cache_dir(**environment: str) -> str:
    return _run(**environment).stdout.strip()


def test_kernels_are_kept_in_the_users_cache(tmp_path: Path) -> None:
    assert _cache_dir(XDG_CACHE_HOME=str(tmp_path)) == str(
        tmp_path / "risorius" / f"kernels-{compile_cache.source_digest()}"
    )


def test_a_folder_that_the_user_chose_is_kept(tmp_path: Path) -> None:
    assert _cache_dir(NUMBA_CACHE_DIR=str(tmp_path)) == str(tmp_path)


@pytest.mark.parametrize("variable", ["XDG_CACHE_HOME", "NUMBA_CACHE_DIR"])
def test_a_cache_that_cannot_be_written_is_replaced_with_one_warning(tmp_path: Path, variable: str) -> None:
    (tmp_path / "file").write_text("not a folder")
    done = _run(**{variable: str(tmp_path / "file" / "below"), "TMPDIR": str(tmp_path)})
    made = Path(done.stdout.strip())
    assert made.parent == tmp_path
    assert not made.exists()  # the process has ended
    assert done.stderr.count("cannot be written: each start compiles for itself") == 1


@pytest.fixture
def without_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    def no_home(_path: Path) -> Path:
        raise RuntimeError("Could not determine home directory.")

    for variable in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.setenv(variable, "")
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    monkeypatch.setattr(Path, "expanduser", no_home)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


def test_without_a_home_a_temporary_folder_is_used_from_then_on(without_home: Path) -> None:
    with pytest.warns(RisoriusWarning, match="there is no folder for a cache"):
        used = compile_cache.in_use()
    assert used.parent == without_home
    assert str(used) == numba.config.CACHE_DIR
    assert compile_cache.in_use() == used


def test_what_a_cache_that_cannot_be_written_holds_is_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    monkeypatch.setattr(compile_cache, "_is_writable", lambda _: False)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    (tmp_path / "kernel.nbi").write_text("compiled")
    with pytest.warns(RisoriusWarning, match="cannot be written"):
        compile_cache.use_own_folder()
    assert (compile_cache.in_use() / "kernel.nbi").read_text() == "compiled"
    assert compile_cache.in_use() != tmp_path


def test_any_change_of_a_source_makes_another_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    module = tmp_path / "core" / "kernels" / "compile_cache.py"
    (tmp_path / "face").mkdir()
    source = tmp_path / "face" / "kernel.py"
    source.write_text("a = 1\n")
    monkeypatch.setattr(compile_cache, "__file__", str(module))
    before = compile_cache.source_digest()
    source.write_text("a = 2\n")
    assert compile_cache.source_digest() != before
