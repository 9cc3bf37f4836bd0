import os
import subprocess
import sys
from pathlib import Path

import pytest

from risorius.core.kernels import compile_cache

CODE = "import numba, risorius.core.kernels.jit; print(numba.config.CACHE_DIR)"


def _cache_dir(**environment: str) -> str:
    inherited = {k: v for k, v in os.environ.items() if k not in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")}
    command = [sys.executable, "-c", CODE]
    done = subprocess.run(command, env=inherited | environment, capture_output=True, text=True, check=True)
    return done.stdout.strip()


def test_kernels_are_kept_in_the_users_cache(tmp_path: Path) -> None:
    assert _cache_dir(XDG_CACHE_HOME=str(tmp_path)) == str(
        tmp_path / "risorius" / f"kernels-{compile_cache.source_digest()}"
    )


def test_a_folder_that_the_user_chose_is_kept(tmp_path: Path) -> None:
    assert _cache_dir(NUMBA_CACHE_DIR=str(tmp_path)) == str(tmp_path)


def test_any_change_of_a_source_makes_another_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    module = tmp_path / "core" / "kernels" / "compile_cache.py"
    (tmp_path / "face").mkdir()
    source = tmp_path / "face" / "kernel.py"
    source.write_text("a = 1\n")
    monkeypatch.setattr(compile_cache, "__file__", str(module))
    before = compile_cache.source_digest()
    source.write_text("a = 2\n")
    assert compile_cache.source_digest() != before
